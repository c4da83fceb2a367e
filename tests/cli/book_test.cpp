// Flipbooks on the command line: bake, and glare --book.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "program.h"

namespace aureole::cli {
namespace {

// As small as books get: five frames.
const std::string kBake =
    "bake --width 96 --fov 40 --size 64 --pupils 5,7 --texture-frames 2,1,1,1 --halo-frames 1 "
    "--streak-frames 2 --lid-states 1 --measure 0 ";
const std::string kLook = "glare in.exr --fov 40 --adaptation 1 --time 2 ";

class Book : public CliTest {
  protected:
    void SetUp() override {
        static const std::string book = [this] {
            EXPECT_EQ(run(kBake + "-o book.aureole").exit_code, 0);
            return bytes("book.aureole");
        }();
        write_bytes("book.aureole", book);
        write("in.exr", point(96, 54, 3, 40, 20, 1000));
    }
    std::string refusal(const std::string& words, int code) const {
        const Outcome outcome = run(words);
        EXPECT_EQ(outcome.exit_code, code) << words << "\n" << outcome.err;
        return outcome.err;
    }
};

TEST_F(Book, IsBakedWholeOrNotAtAllAndTheSameEachTime) {
    const auto json = report(kBake + "-o again.aureole");
    EXPECT_EQ(bytes("again.aureole"), bytes("book.aureole"));
    EXPECT_EQ(json["bytes"], bytes("book.aureole").size());
    EXPECT_EQ(json["frames"]["texture"], 2);
    EXPECT_EQ(json["frames"]["streaks"], 2);
    EXPECT_EQ(json["parameters"]["age_years"], 30);
    Conditions full;
    full.largest_file = 30'000;
    const Outcome outcome = run(kBake + "-o full.aureole", full);
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_TRUE(names_all(outcome.err, {"full.aureole"}));
    EXPECT_FALSE(exists("full.aureole"));
    EXPECT_EQ(refusal(kBake + "-o none/a.aureole", 1).find("frames"), std::string::npos);
}

TEST_F(Book, ReportsItsErrors) {
    const auto json = report(
        "bake -o b.aureole --width 96 --fov 40 --size 64 --pupils 5,7 --texture-frames 2,1,1,1 "
        "--halo-frames 2 --streak-frames 2 --lid-states 2 --measure 1");
    for (const char* lids : {"open_lids", "covering_lids"}) {
        EXPECT_LT(json["errors"]["at_frames"][lids]["worst_ring"], 0.02);
        EXPECT_GT(json["errors"]["between_frames"][lids]["texture"], 0.1);
    }
    EXPECT_EQ(json["errors"]["to_deg"], 5);
}

// A raster that cuts its patterns is measured where it keeps them.
TEST_F(Book, SaysUpToWhichAngleItIsMeasured) {
    const Outcome outcome =
        run("bake -o b.aureole --size 96 --pupils 6,6 --texture-frames 1,1,1,1 --halo-frames 1 "
            "--streak-frames 1 --lid-states 1 --measure 1");
    EXPECT_TRUE(names_all(outcome.out, {"worst ring from 0.3 to 1.4 deg"})) << outcome.out;
}

TEST_F(Book, ShowsNearlyWhatDirectComputationShows) {
    const std::string eye = "glare in.exr --fov 40 --time 2 --pupil 9 ";
    // Its widest pupil is 7 mm: the nearest frame, and a note.
    const Outcome outcome = run(eye + "-o wide.exr --book book.aureole");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(names_all(outcome.err, {"book.aureole", "5 to 7 mm"}));
    // The same light arrives, within what moves at most: the pattern.
    ASSERT_EQ(run(kLook + "-o direct.exr").exit_code, 0);
    ASSERT_EQ(run(kLook + "-o book.exr --book book.aureole").exit_code, 0);
    const Image direct = read("direct.exr").image();
    const Image book = read("book.exr").image();
    EXPECT_FALSE(identical(direct, book));
    double sum = 0;
    double difference = 0;
    for (std::size_t i = 0; i < 3 * direct.pixels(); ++i) {
        const auto wanted = static_cast<double>(direct.plane(0)[i]);
        sum += wanted;
        difference += std::abs(static_cast<double>(book.plane(0)[i]) - wanted);
    }
    EXPECT_LT(difference, 0.05 * sum);
    const auto json = report(kLook + "-o book.exr --book book.aureole");
    EXPECT_EQ(json["parameters"]["book"], "book.aureole");
    const auto& energy = json["energy"];
    EXPECT_NEAR((energy["out"].get<double>() + energy["off_picture"].get<double>()) /
                    energy["in"].get<double>(),
                1, 1e-4);
}

TEST_F(Book, FramesDoNotDependOnTheirOrder) {
    for (int frame = 0; frame < 6; ++frame) {
        write("in.000" + std::to_string(frame) + ".exr", point(96, 54, 3, 40, 20, 1000));
    }
    const std::string common =
        "glare in.%04d.exr --fov 40 --adaptation 1 --fps 6 --motion saccades --blink auto "
        "--book book.aureole ";
    ASSERT_EQ(run(common + "--frames 0-5 -o one.%04d.exr").exit_code, 0);
    ASSERT_EQ(run(common + "--frames 5,4,3,2,1,0 -o two.%04d.exr --threads 1").exit_code, 0);
    int changed = 0;
    for (int frame = 0; frame < 6; ++frame) {
        const std::string end = ".000" + std::to_string(frame) + ".exr";
        const Image one = read("one" + end).image();
        EXPECT_TRUE(identical(one, read("two" + end).image())) << frame;
        if (frame > 0) changed += identical(one, read("one.0000.exr").image()) ? 0 : 1;
    }
    EXPECT_GT(changed, 0);
}

TEST_F(Book, WhatIsNotTheBooksIsRefusedWithBothValues) {
    const std::string look = kLook + "-o out.exr --book book.aureole ";
    const std::vector<std::pair<std::string, std::vector<std::string>>> cases = {
        {"--age 61", {"--age", "30", "61"}},
        {"--eyelashes 5", {"--eyelashes", "7", "5"}},
        {"--seed 2", {"--seed", "1", "2"}},
        {"--scatter ijspeert", {"--scatter", "cie", "ijspeert"}},
        {"--pigmentation blue", {"--pigmentation", "brown", "blue"}},
        {"--preset vivid", {"--corona-contrast", "--preset", "1", "3.44639"}},
        {"--pupil-shape slit", {"--pupil-shape", "round", "slit"}},
        {"--source-spectrum sodium", {"--source-spectrum", "d65", "sodium"}},
        {"--perspective on", {"--perspective", "off", "on"}}};
    for (const auto& [words, named] : cases) {
        EXPECT_TRUE(names_all(refusal(look + words, 2), named)) << words;
        EXPECT_FALSE(exists("out.exr"));
    }
    EXPECT_TRUE(names_all(refusal("glare in.exr -o out.exr --time 1 --adaptation 1 --fov 30 --book "
                                  "book.aureole",
                                  2),
                          {"--fov", "0.416667 deg", "0.3125 deg"}));
    EXPECT_EQ(run(look + "--halo 0 --streaks 2 --eyelid 0.2 --pupil 6").exit_code, 0);
}

TEST_F(Book, OptionsThatDoNotGoTogetherAreNamed) {
    const std::string look = "glare in.exr -o out.exr --fov 40 --book book.aureole ";
    EXPECT_TRUE(names_all(refusal(look, 2), {"--book", "--time or --fps"}));
    EXPECT_TRUE(names_all(refusal(look + "--observer camera", 2), {"--book", "--observer eye"}));
    EXPECT_TRUE(names_all(refusal(look + "--time 1 --psf in.exr", 2), {"--psf", "--time"}));
    EXPECT_TRUE(names_all(refusal(kBake + "-o b.aureole --pupil 4", 2), {"--pupil"}));
    EXPECT_TRUE(
        names_all(refusal(kBake + "-o b.aureole --scatter none", 2), {"--scatter", "none"}));
    EXPECT_TRUE(names_all(refusal(kBake + "-o b.aureole --source-spectrum rgb", 2),
                          {"--source-spectrum", "rgb"}));
    EXPECT_TRUE(names_all(refusal("bake -o b.aureole --size 511", 2), {"511", "even"}));
    EXPECT_TRUE(names_all(refusal("bake -o b.aureole --pupils 8,2", 2), {"--pupils", "8,2"}));
    EXPECT_TRUE(names_all(refusal("bake -o b.aureole --texture-frames 7,2,4,1", 2),
                          {"--texture-frames", "odd"}));
    EXPECT_TRUE(names_all(refusal("bake -o b.aureole --texture-frames 3,1", 2),
                          {"--texture-frames", "4 whole numbers"}));
}

TEST_F(Book, DamagedAndForeignFilesAreNamed) {
    const std::string look = kLook + "-o out.exr --book ";
    std::string damaged = bytes("book.aureole");
    damaged[damaged.size() - 5] ^= 0x10;
    write_bytes("damaged.aureole", damaged);
    EXPECT_TRUE(names_all(refusal(look + "damaged.aureole", 1),
                          {"damaged.aureole", "is damaged", "streaks"}));
    write_bytes("short.aureole", damaged.substr(0, damaged.size() / 2));
    EXPECT_TRUE(names_all(refusal(look + "short.aureole", 1), {"short.aureole", "cut off"}));
    EXPECT_TRUE(names_all(refusal(look + "in.exr", 1), {"in.exr", "is no flipbook"}));
    EXPECT_TRUE(names_all(refusal(look + "none.aureole", 1), {"none.aureole", "no such file"}));
    EXPECT_FALSE(exists("out.exr"));
}

}  // namespace
}  // namespace aureole::cli
