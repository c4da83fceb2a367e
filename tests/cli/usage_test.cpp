// What the program says when it is asked for help, or asked for what cannot be.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "program.h"

namespace aureole::cli {
namespace {

using Help = CliTest;
using Usage = CliTest;

const std::vector<std::string> kEverywhere = {"--help",    "--version", "--json", "--quiet",
                                              "--threads", "--seed",    "--depth"};
const std::vector<std::string> kEye = {
    "--preset",      "--age",   "--pigmentation", "--scatter", "--corona-contrast", "--halo",
    "--streaks",     "--pupil", "--pupil-model",  "--eyelid",  "--eyelashes",       "--adaptation",
    "--perspective", "--fov",   "physical",       "vivid",     "watson-yellott"};

TEST_F(Help, ListsTheCommands) {
    const Outcome outcome = run("--help");
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.err, "");
    EXPECT_TRUE(names_all(outcome.out, {"glare", "meter", "psf", "scene", "--help", "--version"}));
}

TEST_F(Help, OfEveryCommandNamesItsOptions) {
    const Outcome glare = run("glare --help");
    const Outcome psf = run("psf --help");
    const Outcome scene = run("scene --help");
    for (const Outcome& outcome : {glare, psf, scene}) {
        EXPECT_EQ(outcome.exit_code, 0);
        EXPECT_EQ(outcome.err, "");
        EXPECT_TRUE(names_all(outcome.out, kEverywhere));
    }
    EXPECT_TRUE(names_all(glare.out, kEye));
    EXPECT_TRUE(names_all(psf.out, kEye));
    EXPECT_TRUE(names_all(glare.out, {"INPUT",
                                      "--output",
                                      "--frames",
                                      "--white-luminance",
                                      "--method",
                                      "--cluster-error",
                                      "--resolution",
                                      "--output-layers",
                                      "--matte",
                                      "--threshold",
                                      "--gain",
                                      "--field-varying",
                                      "--psf",
                                      "--surround",
                                      "--side-by-side",
                                      "--passes",
                                      "--cluster-side",
                                      "--supersampling",
                                      "--halation",
                                      "--tone-map",
                                      "--exposure",
                                      "--ocio-config",
                                      "none|narkowicz|hill|aces"}));
    EXPECT_TRUE(names_all(psf.out, {"--output", "--width", "--height", "--size", "--component",
                                    "bloom", "corona", "halo", "streaks"}));
    EXPECT_TRUE(
        names_all(scene.out, {"NAME", "night-street", "sun", "stars", "point", "bars", "--output",
                              "--width", "--height", "--fov", "--white-luminance", "--tone-map"}));
}

TEST_F(Help, VersionIsPrintedEverywhere) {
    for (const char* words : {"--version", "glare --version", "psf --version", "scene --version"}) {
        const Outcome outcome = run(words);
        EXPECT_EQ(outcome.exit_code, 0) << words;
        EXPECT_EQ(outcome.err, "") << words;
        EXPECT_EQ(outcome.out.rfind("aureole ", 0), 0U) << outcome.out;
    }
}

struct WrongUsage {
    std::string words;                 // the command line
    std::vector<std::string> message;  // what standard error must name
};

std::ostream& operator<<(std::ostream& stream, const WrongUsage& usage) {
    return stream << "aureole " << usage.words;
}

class WrongUsageTest : public CliTest, public testing::WithParamInterface<WrongUsage> {};

TEST_P(WrongUsageTest, EndsWithTwoAndAMessage) {
    write("in.exr", noise(8, 6, 3));
    const Outcome outcome = run(GetParam().words);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(names_all(outcome.err, GetParam().message));
    EXPECT_EQ(outcome.err.rfind("aureole: ", 0), 0U) << outcome.err;
    EXPECT_EQ(folder_.names(), std::vector<std::string>{"in.exr"});
}

INSTANTIATE_TEST_SUITE_P(
    CommandLine, WrongUsageTest,
    testing::Values(
        WrongUsage{"", {"command", "glare", "psf", "scene"}},
        WrongUsage{"gleam in.exr", {"gleam", "glare", "psf", "scene"}},
        WrongUsage{"--frobnicate", {"--frobnicate"}},
        WrongUsage{"glare", {"INPUT", "glare --help"}},
        WrongUsage{"glare in.exr", {"--output", "required"}},
        WrongUsage{"psf", {"--output", "psf --help"}},
        WrongUsage{"scene -o a.exr", {"NAME", "scene --help"}},
        WrongUsage{"glare in.exr -o out.exr --frobnicate", {"--frobnicate", "glare --help"}},
        WrongUsage{"glare --ouput out.exr in.exr", {"--ouput"}},
        WrongUsage{"psf in.exr -o out.exr", {"in.exr", "psf --help"}},
        WrongUsage{"glare in.exr -o", {"--output", "value"}},
        WrongUsage{"glare in.exr -o out.exr --fov", {"--fov", "value"}},
        WrongUsage{"glare in.exr -o out.exr --fov 20 --fov 30", {"--fov", "more than once"}},
        WrongUsage{"scene nowhere -o a.exr", {"nowhere", "night-street", "bars"}}));

INSTANTIATE_TEST_SUITE_P(
    Value, WrongUsageTest,
    testing::Values(
        WrongUsage{"glare in.exr -o out.exr --fov 0", {"--fov", "0", "360"}},
        WrongUsage{"glare in.exr -o out.exr --fov -5", {"--fov", "-5", "above 0"}},
        WrongUsage{"glare in.exr -o out.exr --fov 200 --perspective on", {"--fov", "200", "180"}},
        WrongUsage{"glare in.exr -o out.exr --fov 200", {"--fov", "200", "180", "--perspective"}},
        WrongUsage{"glare in.exr -o out.exr --fov 361 --perspective off", {"--fov", "361", "360"}},
        WrongUsage{"glare in.exr -o out.exr --fov nan", {"--fov", "nan", "number"}},
        WrongUsage{"glare in.exr -o out.exr --fov inf", {"--fov", "inf", "number"}},
        WrongUsage{"glare in.exr -o out.exr --fov wide", {"--fov", "wide", "number"}},
        WrongUsage{"glare in.exr -o out.exr --fov 60deg", {"--fov", "60deg", "number"}},
        WrongUsage{"glare in.exr -o out.exr --perspective 3d", {"--perspective", "3d", "auto"}},
        WrongUsage{"glare in.exr -o out.exr --pupil 0", {"pupil", "0", "1 to 9"}},
        WrongUsage{"glare in.exr -o out.exr --pupil 50", {"pupil", "50", "1 to 9"}},
        WrongUsage{"glare in.exr -o out.exr --pupil abc", {"--pupil", "abc", "auto", "number"}},
        WrongUsage{"glare in.exr -o out.exr --pupil nan", {"--pupil", "nan", "number"}},
        WrongUsage{"glare in.exr -o out.exr --adaptation -3", {"adaptation", "-3", "cd/m2"}},
        WrongUsage{"glare in.exr -o out.exr --age -1", {"age", "-1", "1 to 120"}},
        WrongUsage{"glare in.exr -o out.exr --eyelid 1", {"eyelid", "1", "below 1"}},
        WrongUsage{"glare in.exr -o out.exr --eyelid -0.1", {"eyelid", "-0.1"}},
        WrongUsage{"glare in.exr -o out.exr --eyelashes 101", {"--eyelashes", "101", "100"}},
        WrongUsage{"glare in.exr -o out.exr --eyelashes 1.5", {"--eyelashes", "1.5", "whole"}},
        WrongUsage{"glare in.exr -o out.exr --halo -1", {"halo", "-1"}},
        WrongUsage{"glare in.exr -o out.exr --streaks 1e9", {"streaks", "20"}},
        WrongUsage{"glare in.exr -o out.exr --corona-contrast -2", {"contrast", "-2"}},
        WrongUsage{"glare in.exr -o out.exr --scatter fog", {"--scatter", "fog", "cie"}},
        WrongUsage{"glare in.exr -o out.exr --preset epic", {"--preset", "epic", "vivid"}},
        WrongUsage{"glare in.exr -o out.exr --pigmentation red", {"--pigmentation", "red", "blue"}},
        WrongUsage{"glare in.exr -o out.exr --seed -1", {"--seed", "-1", "from 0"}},
        WrongUsage{"glare in.exr -o out.exr --threads -1", {"--threads", "-1", "0 to 1024"}},
        WrongUsage{"glare in.exr -o out.exr --white-luminance 0",
                   {"--white-luminance", "0", "above 0"}},
        WrongUsage{"glare in.exr -o out.exr --threshold -1", {"--threshold", "-1", "from 0"}},
        WrongUsage{"glare in.exr -o out.exr --gain -0.5", {"--gain", "-0.5", "from 0"}},
        WrongUsage{"glare in.exr -o out.exr --surround mirror", {"--surround", "mirror", "same"}},
        WrongUsage{"glare in.exr -o out.exr --gain inf", {"--gain", "inf", "number"}},
        WrongUsage{"glare in.exr -o out.exr --method magic", {"--method", "magic", "direct"}},
        WrongUsage{"glare in.exr -o out.exr --cluster-error .1",
                   {"--cluster-error", ".1", "--method", "hybrid", "fft is exact"}},
        WrongUsage{"glare in.exr -o out.exr --resolution eighth",
                   {"--resolution", "eighth", "full, half or quarter"}},
        WrongUsage{"glare in.exr -o out.exr --resolution half --method sprites",
                   {"--resolution", "half", "full", "--method sprites"}},
        WrongUsage{"glare in.exr -o out.exr --depth quarter", {"--depth", "quarter", "half"}},
        WrongUsage{"glare in.exr -o out.png --exposure nan", {"--exposure", "nan", "100"}},
        WrongUsage{"glare in.exr -o out.png --tone-map pretty", {"--tone-map", "pretty", "hill"}},
        WrongUsage{"psf -o out.exr --pupil 4 --size 64", {"--size", "64", "odd"}},
        WrongUsage{"psf -o out.exr --pupil 4 --size 0", {"--size", "0", "from 1"}},
        WrongUsage{"psf -o out.exr --pupil 4 --width -7", {"--width", "-7", "from 1"}},
        WrongUsage{"psf -o out.exr --pupil 4 --component nose", {"--component", "nose", "halo"}},
        WrongUsage{"psf -o out.exr --pupil 2 --component halo", {"halo", "pupil"}},
        WrongUsage{"psf -o out.exr --pupil 5 --component streaks --eyelashes 0", {"lash"}},
        WrongUsage{"scene point -o out.exr --width 0", {"--width", "0", "from 1"}},
        WrongUsage{"scene point -o out.exr --height 1e3", {"--height", "1e3", "whole"}},
        WrongUsage{"scene point -o out.exr --fov 175", {"fov", "175", "170"}},
        WrongUsage{"scene point -o out.exr --width 8 --point-x 8", {"point_x", "8"}},
        WrongUsage{"scene point -o out.exr --white-luminance -1", {"--white-luminance", "-1"}}));

INSTANTIATE_TEST_SUITE_P(
    Combination, WrongUsageTest,
    testing::Values(
        WrongUsage{"glare in.exr -o out.xyz", {"out.xyz", ".exr", ".png"}},
        WrongUsage{"glare in.exr -o out", {"out", ".exr", ".png"}},
        WrongUsage{"psf --pupil 4 -o out.gif", {"out.gif", ".exr"}},
        WrongUsage{"glare in.exr -o out.exr --tone-map hill", {"--tone-map", "hill", "PNG"}},
        WrongUsage{"glare in.exr -o out.png --ocio-view Film", {"--ocio-view", "--tone-map ocio"}},
        WrongUsage{"glare in.exr -o out.png --depth half", {"--depth", "half", "EXR"}},
        WrongUsage{"glare in.exr -o out.png --output-layers both", {"--output-layers", "EXR"}},
        WrongUsage{"glare in.exr -o out.exr --side-by-side b.exr", {"--side-by-side", "PNG"}},
        WrongUsage{"glare in.exr -o out.exr --psf k.exr --age 60", {"--psf", "--age"}},
        WrongUsage{"glare in.exr -o a.exr -o a.exr", {"a.exr", "more than once"}},
        WrongUsage{"glare in.exr -o a.png --side-by-side a.png", {"a.png", "more than once"}},
        WrongUsage{"glare in.exr in.exr -o out.exr", {"--output", "out.exr", "folder"}},
        WrongUsage{"glare in.exr -o .", {"in.exr", "overwritten"}},
        WrongUsage{"glare in.exr -o out.exr --frames many", {"frames", "many", "1001-1240"}},
        WrongUsage{"glare in.exr -o out.exr --frames 5-1", {"frames", "5-1", "last"}},
        WrongUsage{"glare s.%04d.exr -o out.exr --frames 1-3", {"out.exr", "%04d"}},
        WrongUsage{"glare in.exr -o o.%04d.exr --frames 1-3", {"in.exr", "%04d"}},
        WrongUsage{"glare s.%04d.exr -o o.%04d.exr", {"s.%04d.exr", "--frames"}},
        WrongUsage{"glare s.####.exr t.####.exr -o o.####.exr --frames 1-2", {"--frames", "one"}}));

}  // namespace
}  // namespace aureole::cli
