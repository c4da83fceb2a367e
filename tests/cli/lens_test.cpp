// aureole lens: list, show, draw, check, convert.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "aureole/lens/library.h"
#include "program.h"

namespace aureole::cli {
namespace {

using Lens = CliTest;
using nlohmann::json;

// A thin biconvex lens of N-BK7 that is all its own stop.
const std::string kSinglet = R"(name = "Singlet"
[[surface]]
stop = true
thickness_mm = 1.0
semi_aperture_mm = 5.0
[[surface]]
radius_mm = 50.0
thickness_mm = 3.0
index = 1.5168
abbe = 64.17
semi_aperture_mm = 10.0
[[surface]]
radius_mm = -50.0
thickness_mm = 47.0
semi_aperture_mm = 10.0
)";

std::string replaced(std::string text, const std::string& what, const std::string& with) {
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return text.replace(at, what.size(), with);
}

TEST_F(Lens, ListNamesEveryLens) {
    const Outcome outcome = run("lens list");
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.err, "");
    const json report = this->report("lens list");
    ASSERT_EQ(report["lenses"].size(), lens::shipped_lenses().size());
    for (std::size_t i = 0; i < report["lenses"].size(); ++i) {
        const json& one = report["lenses"][i];
        EXPECT_EQ(one["id"], lens::shipped_lenses()[i].id);
        EXPECT_TRUE(names_all(outcome.out, {one["id"], one["name"], one["patent"]}));
        EXPECT_GT(one["focal_length_mm"], 0);
        EXPECT_GE(one["surfaces"], 3);
    }
    EXPECT_TRUE(names_all(outcome.out, {"72.1-194.01", "US 5,835,272"}));
}

// Reference values of the table of lenses, from an independent paraxial program.
TEST_F(Lens, ShowReportsTheHeliar) {
    const json heliar = report("lens show heliar");
    EXPECT_NEAR(heliar["efl_mm"], 99.236, 0.001 * 99.236);
    EXPECT_NEAR(heliar["bfd_mm"], 81.315, 0.001 * 81.315);
    EXPECT_NEAR(heliar["f_number_paraxial"], 3.43, 0.005);
    EXPECT_EQ(heliar["f_number_stated"], nullptr);
    // None is stated, so that the printed stop is the one in use.
    EXPECT_EQ(heliar["f_number_printed_stop"], heliar["f_number"]);
    EXPECT_NEAR(heliar["f_number_printed_stop_paraxial"], heliar["f_number_paraxial"], 1e-9);
    EXPECT_NEAR(heliar["stop_radius_mm"], 11.6, 1e-3);
    EXPECT_EQ(heliar["stop_surface"], 6);
    EXPECT_EQ(heliar["surfaces"], 9);
    EXPECT_EQ(heliar["ghosts"], 28);
    // 5 faces before the stop, 3 behind it.
    EXPECT_EQ(heliar["ghosts_same_side"], 10 + 3);
    EXPECT_EQ(heliar["table"].size(), 9U);
    EXPECT_NEAR(heliar["entrance_pupil_diameter_mm"],
                heliar["efl_mm"].get<double>() / heliar["f_number_paraxial"].get<double>(), 1e-9);
    // The rear principal plane is one focal length in front of the rear focus.
    EXPECT_NEAR(heliar["sensor_z_mm"].get<double>() - heliar["rear_principal_z_mm"].get<double>(),
                heliar["efl_mm"], 1e-9);

    const Outcome text = run("lens show heliar");
    EXPECT_EQ(text.exit_code, 0);
    EXPECT_TRUE(names_all(text.out, {"Voigtlander Heliar", "99.236 mm", "81.315 mm", "28",
                                     "surface 6", "11.6 mm", "-89.35", "pupil", "principal"}));
}

// The oracle of the second seed: at 28 mm f/2.8 the effective aperture is 10 mm, the stop about
// 22 mm wide.
TEST_F(Lens, ShowSolvesTheStopOfTheNikon) {
    const json nikon = report("lens show nikon-28-75");
    EXPECT_EQ(nikon["f_number"], 2.8);
    EXPECT_NEAR(nikon["efl_mm"].get<double>() / 2.8, 10, 0.4);
    EXPECT_NEAR(2 * nikon["stop_radius_mm"].get<double>(), 22, 1);
    EXPECT_EQ(nikon["ghosts"], 351);
    // The printed stop is smaller: f/3.44 paraxially, a little slower by real rays. `lens check`
    // says the same.
    EXPECT_NEAR(nikon["f_number_printed_stop_paraxial"], 3.44, 0.005);
    EXPECT_NEAR(nikon["f_number_printed_stop"], 3.49, 0.005);
    EXPECT_TRUE(names_all(run("lens show nikon-28-75").out, {"f/3.494", "paraxially f/3.44"}));
    EXPECT_TRUE(names_all(run("lens check nikon-28-75").out, {"f/3.49 (paraxially f/3.44)"}));
    const json slow = report("lens show nikon-28-75 --f-number 8");
    EXPECT_NEAR(slow["stop_radius_mm"].get<double>() / nikon["stop_radius_mm"].get<double>(),
                2.8 / 8, 0.01);
    EXPECT_EQ(slow["parameters"]["f_number"], 8);
}

TEST_F(Lens, ShowTakesThePositionsOfAZoom) {
    const std::map<std::string, double> focal_mm = {
        {"", 72.118}, {":wide", 72.118}, {":mid", 134.948}, {":tele", 193.910}};
    for (const auto& [position, mm] : focal_mm) {
        const json report = this->report("lens show canon-70-200" + position);
        EXPECT_NEAR(report["efl_mm"], mm, 0.001 * mm) << position;
        EXPECT_EQ(report["positions"], (json{"wide", "mid", "tele"}));
        EXPECT_EQ(report["position"], position.empty() ? "wide" : position.substr(1));
    }
    const Outcome wrong = run("lens show canon-70-200:far");
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_TRUE(names_all(wrong.err, {"position = far", "wide, mid, tele"}));
}

TEST_F(Lens, FocusMovesTheSensorBack) {
    const json far = report("lens show double-gauss");
    const json near = report("lens show double-gauss --focus 1");
    // x' = f^2 / x with x = 1000 mm less what is behind the front focus: about 50^2 / 895.
    const double moved = near["sensor_z_mm"].get<double>() - far["sensor_z_mm"].get<double>();
    EXPECT_NEAR(moved, 2.8, 0.1);
    EXPECT_EQ(near["parameters"]["focus_distance_m"], 1);
    EXPECT_EQ(far["parameters"]["focus_distance_m"], nullptr);
}

TEST_F(Lens, SweepReportsVignetting) {
    const json report = this->report("lens show heliar --sweep --angles 0,10,20");
    const json& sweep = report["sweep"];
    ASSERT_EQ(sweep.size(), 3U);
    EXPECT_EQ(sweep[1]["angle_deg"], 10);
    EXPECT_NEAR(sweep[0]["relative_area"], 1, 1e-12);
    EXPECT_NEAR(sweep[1]["image_height_mm"], 99.236 * std::tan(std::acos(-1) / 18), 0.2);
    EXPECT_LT(sweep[1]["relative_area"], sweep[0]["relative_area"]);
    EXPECT_LT(sweep[2]["relative_area"], sweep[1]["relative_area"]);
    // The beam on the axis is as wide as the f-number says.
    const double diameter_mm =
        2 * std::sqrt(sweep[0]["open_area_mm2"].get<double>() / std::acos(-1));
    EXPECT_NEAR(report["efl_mm"].get<double>() / diameter_mm, report["f_number"], 0.02);

    const json whole = this->report("lens show heliar --sweep");
    EXPECT_EQ(whole["sweep"].size(), 11U);
    EXPECT_NEAR(whole["sweep"].back()["angle_deg"], 30, 1e-9);  // half of the stated 60
    EXPECT_TRUE(names_all(run("lens show heliar --sweep").out, {"angle deg", "illumination %"}));
}

TEST_F(Lens, DrawWritesFilesThatOpen) {
    const json report = this->report(
        "lens draw nikon-28-75 -o a.svg -o a.png -o a.pdf --angles 0,-10.5 --rays 5 --width 900");
    EXPECT_EQ(report["outputs"], (json{"a.svg", "a.png", "a.pdf"}));
    EXPECT_EQ(report["parameters"]["angles_deg"], (json{0, -10.5}));
    EXPECT_EQ(folder_.names(), (std::vector<std::string>{"a.pdf", "a.png", "a.svg"}));
    EXPECT_TRUE(names_all(bytes("a.svg"), {"<svg", "<title>Nikon 28-75", "</svg>"}));
    EXPECT_EQ(bytes("a.pdf").substr(0, 5), "%PDF-");
    const io::Picture picture = read("a.png");
    EXPECT_EQ(picture.image().width(), 900);
    // Ink of many colours, on paper.
    double darkest = 1;
    double brightest = 0;
    for (std::size_t i = 0; i < picture.image().pixels(); ++i) {
        darkest = std::min(darkest, double{picture.image().plane(0)[i]});
        brightest = std::max(brightest, double{picture.image().plane(0)[i]});
    }
    EXPECT_LT(darkest, 0.05);
    EXPECT_EQ(brightest, 1);
}

TEST_F(Lens, DrawShowsAGhostAndThePosition) {
    const Outcome outcome = run("lens draw canon-70-200:tele -o plain.svg");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "plain.svg\n");
    EXPECT_TRUE(names_all(bytes("plain.svg"), {"70-200 mm f/2.8 L, tele</title>"}));
    const json ghost = report("lens draw canon-70-200:tele -o ghost.svg --ghost 10,4");
    EXPECT_EQ(ghost["parameters"]["ghost"], (json{10, 4}));
    EXPECT_EQ(ghost["parameters"]["angles_deg"].size(), 1U);
    EXPECT_NE(bytes("ghost.svg"), bytes("plain.svg"));
}

TEST_F(Lens, ADiskThatFillsUpLeavesNothing) {
    for (const char* name : {"a.svg", "a.png", "a.pdf"}) {
        Conditions full;
        full.largest_file = 4096;
        const Outcome outcome = run(std::string("lens draw heliar -o ") + name, full);
        EXPECT_EQ(outcome.exit_code, 1) << name;
        EXPECT_TRUE(names_all(outcome.err, {name, "cannot be written"}));
        EXPECT_TRUE(folder_.names().empty());
    }
}

TEST_F(Lens, CheckNamesTheDoubtsOfTheNikon) {
    const Outcome text = run("lens check nikon-28-75");
    EXPECT_EQ(text.exit_code, 0);
    EXPECT_TRUE(names_all(text.out, {"[f-number]", "surface 15", "f/2.8", "[focal-length]"}));
    const json report = this->report("lens check nikon-28-75");
    bool found = false;
    for (const json& finding : report["findings"]) {
        found = found || (finding["kind"] == "f-number" && finding["surface"] == 15);
    }
    EXPECT_TRUE(found) << report;
    const Outcome strict = run("lens check nikon-28-75 --strict");
    EXPECT_EQ(strict.exit_code, 1);
    EXPECT_EQ(strict.out, text.out);
    EXPECT_TRUE(names_all(strict.err, {"nikon-28-75", "doubtful"}));
}

TEST_F(Lens, CheckOfAGoodTableFindsNothing) {
    write_bytes("good.toml", kSinglet);
    const json report = this->report("lens check good.toml --strict");
    EXPECT_EQ(report["findings"], json::array());
    EXPECT_TRUE(names_all(run("lens check good.toml").out, {"Singlet", "nothing doubtful"}));
}

TEST_F(Lens, CheckLooksAtEveryPosition) {
    const json all = report("lens check canon-70-200");
    std::map<std::string, int> positions;
    for (const json& finding : all["findings"]) ++positions[finding["position"]];
    EXPECT_EQ(positions.size(), 3U) << all;
    const json one = report("lens check canon-70-200:mid");
    EXPECT_EQ(static_cast<int>(one["findings"].size()), positions["mid"]);
}

TEST_F(Lens, ConvertedTablesAreTheSameLens) {
    const json before = report("lens show canon-70-200:tele");
    EXPECT_EQ(run("lens convert canon-70-200 -o zoom.toml").exit_code, 0);
    json after = report("lens show zoom.toml:tele");
    EXPECT_EQ(after["table"], before["table"]);
    EXPECT_EQ(after["efl_mm"], before["efl_mm"]);
    EXPECT_EQ(after["positions"], before["positions"]);
    EXPECT_EQ(run("lens convert canon-70-200:tele -o tele.toml").exit_code, 0);
    after = report("lens show tele.toml");
    EXPECT_EQ(after["table"], before["table"]);
    EXPECT_EQ(after["positions"], json::array());

    // A pbrt table: radius, thickness, index, aperture diameter.
    write_bytes("lens.dat", "50 3 1.5168 20\n-50 1 1 20\n0 46 0 9\n");
    EXPECT_EQ(run("lens convert lens.dat -o lens.toml").exit_code, 0);
    EXPECT_EQ(report("lens show lens.toml")["table"], report("lens show lens.dat")["table"]);
    EXPECT_EQ(report("lens show lens.toml")["stop_printed_radius_mm"], 4.5);

    const Outcome wrong = run("lens convert heliar -o heliar.dat");
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_TRUE(names_all(wrong.err, {"heliar.dat", ".toml"}));
    EXPECT_FALSE(exists("heliar.dat"));
}

struct BadFile {
    std::string name;
    std::string text;
    std::vector<std::string> message;
};

TEST_F(Lens, MalformedFilesAreNamedWithTheirSurface) {
    std::string many = "name = \"many\"\n";
    for (int i = 0; i < 10000; ++i) {
        many += "[[surface]]\nsemi_aperture_mm = 5.0\nthickness_mm = 1.0\n";
    }
    const std::vector<BadFile> files = {
        {"index.toml", replaced(kSinglet, "1.5168", "0.0"), {"surface 2", "index", "0"}},
        {"gap.toml",
         replaced(kSinglet, "thickness_mm = 3.0", "thickness_mm = -3.0"),
         {"surface 2", "-3"}},
        {"nostop.toml", replaced(kSinglet, "stop = true", "stop = false"), {"stop"}},
        {"twostops.toml", replaced(kSinglet, "abbe = 64.17", "stop = true"), {"stop"}},
        {"syntax.toml", "name = \"", {"syntax.toml"}},
        {"empty.toml", "", {"empty.toml"}},
        {"many.toml", many, {"10000", "1000"}},
        {"words.dat", "some words\n", {"words.dat"}},
        {"short.zmx", "SURF 0\n", {"short.zmx"}},
        {"none.seq", "RDY\n", {"none.seq"}},
        {"lens.txt", kSinglet, {"lens.txt", ".toml"}}};
    const auto refuse = [&](const std::string& command, const BadFile& bad) {
        const Outcome outcome = run(command);
        EXPECT_EQ(outcome.exit_code, 1) << command << "\n" << outcome.err;
        EXPECT_EQ(outcome.out, "") << command;
        EXPECT_TRUE(names_all(outcome.err, bad.message)) << command;
        EXPECT_TRUE(names_all(outcome.err, {bad.name})) << command;
    };
    for (const BadFile& bad : files) {
        write_bytes(bad.name, bad.text);
        refuse("lens show " + bad.name, bad);
    }
    refuse("lens check index.toml", files[0]);
    refuse("lens draw index.toml -o out.svg", files[0]);
    refuse("lens convert index.toml -o out.toml", files[0]);
    EXPECT_FALSE(exists("out.svg"));
    EXPECT_FALSE(exists("out.toml"));
}

TEST_F(Lens, FilesThatCannotBeReadAreNamed) {
    std::filesystem::create_directory(file("folder.toml"));
    for (const char* name : {"none.toml", "sub/none.zmx", "folder.toml"}) {
        const Outcome outcome = run(std::string("lens show ") + name);
        EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
        EXPECT_TRUE(names_all(outcome.err, {name}));
    }
}

TEST_F(Lens, WhatIsClippedOrMendedIsNoted) {
    // A semi-aperture above the radius of the surface.
    write_bytes("wide.toml",
                replaced(kSinglet, "semi_aperture_mm = 10.0", "semi_aperture_mm = 60.0"));
    const Outcome outcome = run("lens show wide.toml");
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_TRUE(names_all(outcome.err, {"note: wide.toml", "surface 2", "60", "50"}));
    EXPECT_EQ(run("lens show wide.toml --quiet").err, "");
    const json report = this->report("lens show wide.toml --quiet");
    ASSERT_EQ(report["warnings"].size(), 1U);
    EXPECT_TRUE(names_all(report["warnings"][0].get<std::string>(), {"surface 2"}));
}

TEST_F(Lens, WrongUsageEndsWithTwoAndAMessage) {
    const std::map<std::string, std::vector<std::string>> usages = {
        {"lens", {"list, show, draw, check, convert"}},
        {"lens look", {"unknown command look", "list, show, draw", "aureole lens --help"}},
        {"lens show", {"LENS", "aureole lens show --help"}},
        {"lens show helia", {"lens = helia", "heliar"}},
        {"lens show heliar:wide", {"position = wide", "no positions"}},
        {"lens show heliar --f-number 0", {"--f-number = 0", "above 0"}},
        {"lens show heliar --f-number 0.1", {"f_number = 0.1"}},
        {"lens show heliar --focus 0.01", {"focus_distance_m = 0.01", "at least"}},
        {"lens show heliar --coating gold", {"coating", "gold", "mgf2"}},
        {"lens show heliar --angles 3", {"--angles", "--sweep"}},
        {"lens show heliar --sweep --angles 3,x", {"--angles = x"}},
        {"lens show heliar --sweep --angles -3", {"--angles = -3"}},
        {"lens draw heliar", {"--output"}},
        {"lens draw heliar -o a.gif", {"a.gif", ".svg"}},
        {"lens draw heliar -o a.svg -o a.svg", {"a.svg", "more than once"}},
        {"lens draw heliar -o a.svg -o a.jpg", {"a.jpg"}},
        {"lens draw heliar -o a.svg --angles 90", {"--angles = 90"}},
        {"lens draw heliar -o a.svg --ghost 4", {"--ghost", "FAR,NEAR"}},
        {"lens draw heliar -o a.svg --ghost 6,2", {"ghost = 6,2", "surface 6"}},
        {"lens draw heliar -o a.svg --ghost 2,4", {"ghost = 2,4", "farther first"}},
        {"lens draw heliar -o a.svg --rays 1001", {"--rays = 1001"}},
        {"lens draw heliar -o a.png --width 4", {"--width = 4"}},
        {"lens convert heliar", {"--output"}},
        {"lens list heliar", {"unexpected argument heliar"}}};
    for (const auto& [words, message] : usages) {
        const Outcome outcome = run(words);
        EXPECT_EQ(outcome.exit_code, 2) << words;
        EXPECT_EQ(outcome.out, "") << words;
        EXPECT_TRUE(names_all(outcome.err, message)) << words;
    }
    EXPECT_TRUE(folder_.names().empty());
}

TEST_F(Lens, HelpOfEveryCommandNamesItsOptions) {
    const std::map<std::string, std::vector<std::string>> options = {
        {"lens", {"list", "show", "draw", "check", "convert"}},
        {"lens list", {"--json", "--quiet"}},
        {"lens show", {"LENS", "--f-number", "--focus", "--coating", "--sweep", "--angles"}},
        {"lens draw", {"LENS", "--output", "--angles", "--rays", "--ghost", "--width", "--focus"}},
        {"lens check", {"LENS", "--strict", "--json"}},
        {"lens convert", {"LENS", "--output", ".toml"}}};
    for (const auto& [words, names] : options) {
        const Outcome outcome = run(words + " --help");
        EXPECT_EQ(outcome.exit_code, 0) << words;
        EXPECT_EQ(outcome.err, "") << words;
        EXPECT_TRUE(names_all(outcome.out, names)) << words;
        EXPECT_EQ(run(words + " --version").out.rfind("aureole ", 0), 0U) << words;
    }
}

}  // namespace
}  // namespace aureole::cli
