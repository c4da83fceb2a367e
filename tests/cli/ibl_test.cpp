// aureole ibl: files, layouts, reports, and what it refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "aureole/base/random.h"
#include "aureole/ibl/cube_map.h"
#include "aureole/ibl/lat_long.h"
#include "aureole/ibl/layout.h"
#include "aureole/io/texture.h"
#include "program.h"

namespace aureole::cli {
namespace {

namespace fs = std::filesystem;

class Ibl : public CliTest {
  protected:
    std::vector<std::string> names(const std::string& folder) const {
        std::vector<std::string> found;
        for (const auto& entry : fs::directory_iterator(file(folder))) {
            found.push_back(entry.path().filename().string());
        }
        std::sort(found.begin(), found.end());
        return found;
    }
    io::Texture texture(const std::string& name) const { return io::read_texture(file(name)); }
    void write_cube(const std::string& name, const ibl::CubeMap& cube) const {
        write(name, ibl::layout_from_cube(cube, ibl::Layout::kHorizontalStrip));
    }
};

// Every texel is another colour: any two places, faces or mirror images differ.
ibl::CubeMap labelled_cube(int size) {
    ibl::CubeMap cube(size);
    Random random(11);
    for (int face = 0; face < ibl::kFaces; ++face) {
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                for (int c = 0; c < 3; ++c) {
                    cube.at(face, x, y, c) =
                        static_cast<float>(1 + face + 0.1 * x / size + 0.01 * random.uniform());
                }
            }
        }
    }
    return cube;
}

// A lat-long picture of what `radiance` says of directions.
template <class Radiance>
Image lat_long(int width, const Radiance& radiance) {
    Image image(width, width / 2, 3);
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < width; ++x) {
            const auto d = ibl::direction_of(ibl::LatLongPoint{x + 0.5, y + 0.5}, width, width / 2);
            for (int c = 0; c < 3; ++c) image.at(x, y, c) = static_cast<float>(radiance(d, c));
        }
    }
    return image;
}

Image soft_sky(int width) {
    return lat_long(
        width, [](const ibl::Direction& d, int c) { return 1 + 0.5 * d.y + 0.2 * (c + 1) * d.x; });
}

TEST_F(Ibl, WritesOneSetOfTextures) {
    write("sky.exr", soft_sky(64));
    const auto json = report("ibl sky.exr -o out --size 32 --levels 3");
    EXPECT_EQ(names("out"), (std::vector<std::string>{"brdf.dds", "environment.dds",
                                                      "irradiance.dds", "sh.json"}));
    const io::Texture environment = texture("out/environment.dds");
    EXPECT_EQ(environment.faces, 6);
    ASSERT_EQ(environment.levels.size(), 3U);
    EXPECT_EQ(environment.levels[2].width(), 8);
    EXPECT_EQ(texture("out/irradiance.dds").width(), 32);
    EXPECT_EQ(texture("out/brdf.dds").faces, 1);
    EXPECT_EQ(texture("out/brdf.dds").levels[0].channels(), 2);
    EXPECT_EQ(json["method"], "gather");
    EXPECT_EQ(json["parameters"]["mapping"], "filament");
    EXPECT_EQ(json["parameters"]["texel"], "half");
    EXPECT_EQ(json["nonfinite_texels"], 0);
    EXPECT_EQ(json["levels"].size(), 3U);
    EXPECT_EQ(json["outputs"].size(), 4U);
    for (const char* stage : {"read", "filter", "irradiance", "sh", "brdf", "write"}) {
        EXPECT_GE(json["seconds"][stage].get<double>(), 0) << stage;
    }
}

TEST_F(Ibl, WritesPicturesInEveryArrangement) {
    write_cube("cube.exr", labelled_cube(16));
    const struct {
        std::string arrange;
        std::vector<std::string> level_files;
        int width;
        int height;
    } cases[] = {
        {"strip", {"level_0"}, 96, 16},
        {"cross", {"level_0"}, 64, 48},
        {"lat-long", {"level_0"}, 64, 32},
        {"faces",
         {"level_0_px", "level_0_nx", "level_0_py", "level_0_ny", "level_0_pz", "level_0_nz"},
         16,
         16}};
    for (const auto& c : cases) {
        for (const std::string& format : {std::string("exr"), std::string("hdr")}) {
            const std::string out = c.arrange + format;
            report("ibl cube.exr --size 16 --levels 2 --irradiance-size 4 --brdf-size 8 -o " + out +
                   " --format " + format + " --arrange " + c.arrange);
            for (const std::string& name : c.level_files) {
                const io::Picture picture = read(out + "/" + name + "." + format);
                EXPECT_EQ(picture.image().width(), c.width) << name;
                EXPECT_EQ(picture.image().height(), c.height) << name;
            }
            EXPECT_TRUE(exists(out + "/brdf." + format));
        }
    }
}

// What goes out in any layout comes in again as it was, in the same orientation.
TEST_F(Ibl, EveryLayoutIsReadAsItWasWritten) {
    const ibl::CubeMap cube = labelled_cube(16);
    write_cube("cube.exr", cube);
    const auto same = [&](const std::string& input) {
        const std::string out = "again" + std::to_string(input.size());
        report("ibl " + input + " --size 16 --levels 1 --format ktx2 --texel float -o " + out);
        return identical(texture(out + "/environment.ktx2").levels[0], cube.stacked());
    };
    EXPECT_TRUE(same("cube.exr"));
    for (const char* format : {"dds", "ktx2"}) {
        report(std::string("ibl cube.exr --size 16 --levels 2 --texel float -o tex --format ") +
               format);
        EXPECT_TRUE(same(std::string("tex/environment.") + format));
    }
    report("ibl cube.exr --size 16 --levels 1 -o cross --format exr --arrange cross");
    EXPECT_TRUE(same("cross/level_0.exr"));
    write("vertical-cross.exr", ibl::layout_from_cube(cube, ibl::Layout::kVerticalCross));
    EXPECT_TRUE(same("vertical-cross.exr"));
    write("vertical-strip.exr", ibl::layout_from_cube(cube, ibl::Layout::kVerticalStrip));
    EXPECT_TRUE(same("vertical-strip.exr"));
    report("ibl cube.exr --size 16 --levels 1 -o faces --format exr --arrange faces");
    EXPECT_TRUE(
        same("faces/level_0_px.exr faces/level_0_nx.exr faces/level_0_py.exr "
             "faces/level_0_ny.exr faces/level_0_pz.exr faces/level_0_nz.exr"));
    // Lat-long resamples: a smooth map comes back within a few percent, in its place.
    write("sky.exr", soft_sky(256));
    report("ibl sky.exr --size 32 --levels 1 -o one --format exr --arrange lat-long");
    report("ibl one/level_0.exr --size 32 --levels 1 -o two --texel float");
    report("ibl sky.exr --size 32 --levels 1 -o three --texel float");
    EXPECT_LT(largest_difference(texture("two/environment.dds").levels[0],
                                 texture("three/environment.dds").levels[0]),
              0.02);
}

TEST_F(Ibl, RotationAndMirrorMoveTheSun) {
    // A sun at +X.
    write("sun.exr",
          lat_long(128, [](const ibl::Direction& d, int) { return d.x > 0.95 ? 100.0 : 0.0; }));
    const auto brightest_face = [&](const std::string& options) {
        report("ibl sun.exr --size 8 --levels 1 --texel float -o out " + options);
        const Image stacked = texture("out/environment.dds").levels[0];
        int best = 0;
        for (int face = 1; face < 6; ++face) {
            if (stacked.at(4, 8 * face + 4) > stacked.at(4, 8 * best + 4)) best = face;
        }
        return best;
    };
    EXPECT_EQ(brightest_face(""), 0);
    EXPECT_EQ(brightest_face("--mirror x"), 1);
    EXPECT_EQ(brightest_face("--rotate 90"), 5);      // +Z goes to +X, +X to -Z
    EXPECT_EQ(brightest_face("--rotate 0,0,90"), 2);  // roll: +X goes to +Y
}

TEST_F(Ibl, ReportMeasuresTheError) {
    write("sky.exr", soft_sky(128));
    const auto json = report("ibl sky.exr --size 64 --report -o out");
    EXPECT_TRUE(exists("out/report.json"));
    ASSERT_EQ(json["levels"].size(), 3U);
    EXPECT_FALSE(json["levels"][0].contains("error"));
    for (std::size_t i = 1; i < 3; ++i) {
        EXPECT_LT(json["levels"][i]["error"]["rms"].get<double>(), 0.008);
        EXPECT_GT(json["levels"][i]["error"]["texels"].get<int>(), 100);
    }
    const auto file_json = nlohmann::json::parse(bytes("out/report.json"));
    EXPECT_EQ(file_json["levels"], json["levels"]);
    const Outcome outcome = run("ibl sky.exr --size 64 --report -o out");
    EXPECT_TRUE(names_all(outcome.out, {"rms error", "roughness", "environment.dds"}));
}

TEST_F(Ibl, EveryMethodFilters) {
    write("sky.exr", soft_sky(64));
    report("ibl sky.exr --size 16 --levels 3 --texel float --method exact -o exact");
    const io::Texture exact = texture("exact/environment.dds");
    for (const char* method :
         {"gather", "gather --quality draft", "reference", "fis", "precomputed --samples 1,8,64",
          "nl-weighted", "progressive --samples 256", "progressive --sequence multi-jittered"}) {
        report("ibl sky.exr --size 16 --levels 3 --texel float -o out --method " +
               std::string(method));
        const io::Texture filtered = texture("out/environment.dds");
        for (std::size_t level = 1; level < 3; ++level) {
            EXPECT_LT(largest_difference(filtered.levels[level], exact.levels[level]), 0.1)
                << method;
        }
    }
}

TEST_F(Ibl, ConstantLightHasOneCoefficient) {
    write("grey.exr", constant(64, 32, 3, 2));
    report("ibl grey.exr --size 16 --sh 4 -o out --texel float");
    const auto sh = nlohmann::json::parse(bytes("out/sh.json"));
    ASSERT_EQ(sh["radiance"].size(), 16U);
    const double pi = 3.14159265358979323846;
    EXPECT_NEAR(sh["radiance"][0][1].get<double>(), 2 * std::sqrt(4 * pi), 1e-4);
    EXPECT_NEAR(sh["irradiance"][0][1].get<double>(), 2 * pi * std::sqrt(4 * pi), 1e-3);
    for (std::size_t i = 1; i < 16; ++i) {
        EXPECT_NEAR(sh["radiance"][i][0].get<double>(), 0, 1e-4) << i;
    }
    const Image irradiance = texture("out/irradiance.dds").levels[0];
    for (std::size_t i = 0; i < irradiance.pixels(); ++i) {
        EXPECT_NEAR(irradiance.plane(0)[i], 2 * pi, 1e-3);
    }
}

TEST_F(Ibl, CountsWhatItReplacesAndClamps) {
    Image sky = soft_sky(64);
    sky.at(5, 5, 1) = std::nanf("");
    sky.at(9, 9, 0) = INFINITY;
    for (int c = 0; c < 3; ++c) sky.at(30, 10, c) = 1e6F;
    write("sky.exr", sky);
    const auto json = report("ibl sky.exr --size 32 --levels 2 --clamp 10 -o out");
    EXPECT_EQ(json["nonfinite_texels"], 2);
    EXPECT_EQ(json["clamped_texels"], 1);
    EXPECT_GT(json["clamped_share"].get<double>(), 0.5);
    const Outcome outcome = run("ibl sky.exr --size 32 --levels 2 -o out");
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_TRUE(names_all(outcome.err, {"note:", "half", "--texel float"}));  // 1e6 > 65504
    write("dark.exr", constant(64, 32, 3, -1));
    const Outcome dark = run("ibl dark.exr --size 32 --levels 2 --texel rgb9e5 -o out");
    EXPECT_TRUE(names_all(dark.err, {"note:", "negative", "rgb9e5"})) << dark.err;
    EXPECT_EQ(dark.err.find("largest"), std::string::npos) << dark.err;
}

TEST_F(Ibl, PreviewIsTwoFigures) {
    write("sky.exr", soft_sky(64));
    report("ibl sky.exr --size 16 --levels 3 -o out --preview sheet.png");
    const Image sheet = copy(read("sheet.png").color());
    EXPECT_GT(sheet.width(), 500);
    EXPECT_TRUE(exists("sheet-dominant-direction.png"));
}

TEST_F(Ibl, RefusesWhatItCannotUse) {
    write("odd.exr", soft_sky(64));
    write("square.exr", noise(30, 30, 3));
    write("one.exr", noise(1, 1, 3));
    write("small.exr", noise(8, 8, 3));
    write("wide.exr", noise(50, 31, 3));
    write_bytes("broken.dds", "DDS nonsense");
    const struct {
        std::string words;
        std::vector<std::string> told;
        int exit_code;
    } cases[] = {
        {"ibl missing.exr -o out", {"missing.exr"}, 1},
        {"ibl wide.exr -o out", {"wide.exr", "50 x 31"}, 1},
        {"ibl one.exr -o out", {"one.exr", "1 x 1"}, 1},
        {"ibl odd.exr --layout horizontal-cross -o out", {"odd.exr", "64 x 32"}, 1},
        {"ibl broken.dds -o out", {"broken.dds"}, 1},
        {"ibl odd.exr square.exr -o out", {"6"}, 2},
        {"ibl small.exr small.exr small.exr square.exr small.exr small.exr -o out",
         {"square.exr", "30x30", "8x8"},
         1},
        {"ibl wide.exr small.exr small.exr small.exr small.exr small.exr -o out",
         {"wide.exr", "50x31"},
         1},
        {"ibl odd.exr -o out --size 0", {"--size", "0"}, 2},
        {"ibl odd.exr -o out --size 64 --levels 9", {"levels", "9", "7"}, 2},
        {"ibl odd.exr -o out --method magic", {"--method", "magic"}, 2},
        {"ibl odd.exr -o out --samples 32", {"--samples", "gather"}, 2},
        {"ibl odd.exr -o out --method fis --quality high", {"--quality"}, 2},
        {"ibl odd.exr -o out --format exr --texel float", {"--texel"}, 2},
        {"ibl odd.exr -o out --arrange cross", {"--arrange"}, 2},
        {"ibl odd.exr -o out --rotate east", {"--rotate", "east"}, 2},
        {"ibl odd.exr -o out --clamp -1", {"--clamp", "-1"}, 2},
        {"ibl odd.exr -o out --sh 6", {"--sh", "6"}, 2},
        {"ibl odd.exr -o odd.exr/out", {"odd.exr/out"}, 1},
        {"ibl odd.exr -o odd.exr", {"odd.exr"}, 1},
        {"ibl odd.exr -o nowhere/out", {"nowhere"}, 1},
        {"ibl odd.exr -o out --preview sheet.exr", {"sheet.exr"}, 2},
    };
    for (const auto& c : cases) {
        const Outcome outcome = run(c.words);
        EXPECT_EQ(outcome.exit_code, c.exit_code) << c.words << "\n" << outcome.err;
        EXPECT_TRUE(names_all(outcome.err, c.told)) << c.words << "\n" << outcome.err;
        EXPECT_FALSE(exists("out")) << c.words;
    }
}

// A disk that is full in the middle of the set: nothing appears, nothing is left.
TEST_F(Ibl, NothingIsLeftOfAnUnfinishedSet) {
    write("sky.exr", soft_sky(64));
    const std::vector<std::string> before = folder_.names();
    for (const std::size_t largest : {std::size_t{300}, std::size_t{20000}, std::size_t{200000}}) {
        Conditions conditions;
        conditions.largest_file = largest;
        const Outcome outcome = run("ibl sky.exr --size 64 -o out", conditions);
        EXPECT_EQ(outcome.exit_code, 1) << largest;
        EXPECT_EQ(folder_.names(), before) << largest;
    }
    // And what was there stays as it was.
    report("ibl sky.exr --size 32 -o out");
    const std::string old = bytes("out/environment.dds");
    Conditions conditions;
    conditions.largest_file = 20000;
    EXPECT_EQ(run("ibl sky.exr --size 64 -o out", conditions).exit_code, 1);
    EXPECT_EQ(bytes("out/environment.dds"), old);
    EXPECT_EQ(names("out").size(), 4U);
}

// Interrupted while it filters: the set does not appear, and nothing else is left.
TEST_F(Ibl, InterruptLeavesNothing) {
    Image sky = soft_sky(64);
    sky.at(5, 5, 1) = INFINITY;  // the note about it says that filtering begins
    write("sky.exr", sky);
    Program program(folder_.path(), "ibl sky.exr --size 512 --method exact -o out");
    while (program.running() && program.err().find("infinity") == std::string::npos) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    program.signal(SIGINT);
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_TRUE(names_all(outcome.err, {"interrupted"}));
    EXPECT_EQ(folder_.names(), (std::vector<std::string>{"sky.exr"}));
}

TEST_F(Ibl, FilesAreTheSameWithAnyNumberOfThreads) {
    write("sky.exr", noise(64, 32, 3));
    for (const char* method : {"gather", "fis", "progressive"}) {
        const std::string words =
            "ibl sky.exr --size 32 --levels 3 --texel float --method " + std::string(method);
        report(words + " --threads 1 -o one");
        report(words + " --threads 3 -o three");
        for (const std::string& name : names("one")) {
            EXPECT_TRUE(bytes("one/" + name) == bytes("three/" + name)) << method << " " << name;
        }
    }
}

TEST_F(Ibl, SizesNeedNoPowersOfTwo) {
    write("sky.exr", soft_sky(70));
    report("ibl sky.exr --size 37 --levels 3 -o out --texel float");
    const io::Texture environment = texture("out/environment.dds");
    EXPECT_EQ(environment.levels[0].width(), 37);
    EXPECT_EQ(environment.levels[1].width(), 18);
    EXPECT_EQ(environment.levels[2].width(), 9);
    report("ibl sky.exr --size 1 -o one");
    EXPECT_EQ(texture("one/environment.dds").levels.size(), 1U);
}

}  // namespace
}  // namespace aureole::cli
