// What is refused: files and options of flares and of cameras.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "flare_pictures.h"

namespace aureole::cli {
namespace {

using FlareErrors = Flare;

TEST_F(FlareErrors, OfGhostFilesNameFileEntryAndValue) {
    const std::string command = "flare in.exr -o out.exr --ghosts-from g.toml" + kFast;
    for (const auto& [text, words] :
         {std::pair<std::string, std::vector<std::string>>{"[[ghost]]\nsurfaces = [1, 99]\n",
                                                           {"g.toml", "ghost 1", "[1, 99]"}},
          {"[[ghost]]\nsurfaces = [1, 2]\ngain = -3\n", {"g.toml", "line 3", "gain = -3"}},
          {"[[ghost]\n", {"g.toml", "line 1", "TOML"}}}) {
        write_bytes("g.toml", text);
        const Outcome outcome = run(command);
        EXPECT_EQ(outcome.exit_code, 1);
        EXPECT_TRUE(names_all(outcome.err, words));
    }
    EXPECT_FALSE(exists("out.exr"));
}

TEST_F(FlareErrors, OfFilesNameThem) {
    write("black.png", constant(8, 8, 1, 0));
    for (const auto& [words, file] :
         {std::pair("missing.exr -o out.exr", "missing.exr"),
          std::pair("in.exr -o no/out.exr", "no/out.exr"),
          std::pair("in.exr --dump-ghosts no/g.toml", "no/g.toml"),
          std::pair("in.exr -o out.exr --iris black.png", "black.png"),
          std::pair("in.exr -o out.exr --iris no.png", "no.png"),
          std::pair("in.exr -o out.exr --occluder no.png", "no.png"),
          std::pair("in.exr -o out.exr --matte no.png", "no.png"),
          std::pair("in.exr -o out.exr --ghosts-from no.toml", "no.toml"),
          std::pair("in.exr -o out.exr --ghost-texture no.png", "no.png")}) {
        const Outcome outcome = run(std::string("flare ") + words + kFast);
        EXPECT_EQ(outcome.exit_code, 1) << words;
        EXPECT_TRUE(names_all(outcome.err, {file})) << words;
    }
    EXPECT_FALSE(exists("out.exr"));
}

TEST_F(FlareErrors, OfUseEndWithTwo) {
    for (const auto& [words, message] :
         {std::pair<std::string, std::vector<std::string>>{"in.exr", {"--output", "--dump-ghosts"}},
          {"in.exr -o o.exr --only --output-layers both", {"--output-layers", "--only"}},
          {"in.exr -o o.exr --ghosts magic", {"--ghosts", "magic", "hybrid"}},
          {"in.exr -o o.exr --pairs some", {"--pairs", "some", "same-side"}},
          {"in.exr -o o.exr --preset vivid", {"--preset", "vivid", "blog"}},
          {"in.exr -o o.exr --preset blog --ghosts traced", {"--ghosts", "traced", "blog"}},
          {"in.exr -o o.exr --preset blog --pairs all", {"--pairs", "all", "blog"}},
          {"in.exr -o o.exr --ghosts matrix --rays 64", {"--rays", "64", "traced"}},
          {"in.exr -o o.exr --ghosts matrix --wavelengths 3", {"--wavelengths", "traced"}},
          {"in.exr -o o.exr --ghosts traced --hybrid-tolerance 0.1", {"--hybrid-tolerance"}},
          {"in.exr -o o.exr --rays 4", {"--rays", "4", "from 8"}},
          {"in.exr -o o.exr --wavelengths 65", {"--wavelengths", "65", "64"}},
          {"in.exr -o o.exr --strongest 0", {"--strongest", "0"}},
          {"in.exr -o o.exr --energy-dropped 1", {"--energy-dropped", "1"}},
          {"in.exr -o o.exr --hybrid-tolerance 0", {"--hybrid-tolerance", "0"}},
          {"in.exr -o o.exr --coarse-tolerance -1", {"--coarse-tolerance", "-1"}},
          {"in.exr -o o.exr --tint 1,2", {"--tint", "1,2", "R,G,B"}},
          {"in.exr -o o.exr --tint -1", {"--tint", "-1", "at least 0"}},
          {"in.exr -o o.exr --light 1,2", {"--light", "1,2", "RADIANCE"}},
          {"in.exr -o o.exr --light 1deg,2,3", {"--light", "1deg,2,3", "12deg,-3deg"}},
          {"in.exr -o o.exr --light 1,2,-3", {"--light", "1,2,-3", "at least 0"}},
          {"in.exr -o o.exr --light 1,2,3:4", {"--light", "1,2,3:4", "R:G:B"}},
          {"in.exr -o o.exr --light 1,2,3,90", {"--light", "1,2,3,90", "below 90"}},
          {"in.exr -o o.exr --light 1,2,nan", {"--light", "1,2,nan"}},
          {"in.exr -o o.exr --light 1,2,3 --max-lights 4", {"--max-lights", "--found-lights"}},
          {"in.exr -o o.exr --light-threshold 0", {"--light-threshold", "0", "above 0"}},
          {"in.exr -o o.exr --max-lights 0", {"--max-lights", "0", "from 1"}},
          {"in.exr -o o.exr --blades 2", {"--blades", "2", "3 to 64"}},
          {"in.exr -o o.exr --blades 65", {"--blades", "65", "64"}},
          {"in.exr -o o.exr --blade-curvature 2", {"--blade-curvature", "2", "to 1"}},
          {"in.exr -o o.exr --iris-smoothing 1", {"--iris-smoothing", "1", "0.5"}},
          {"in.exr -o o.exr --iris in.exr --blades 6", {"--iris", "--blades"}},
          {"in.exr -o o.exr --sensor 36", {"--sensor", "36", "36x24"}},
          {"in.exr -o o.exr --sensor 36x0", {"--sensor", "36x0", "above 0"}},
          {"in.exr -o o.exr --fov 0", {"--fov", "0", "above 0"}},
          {"in.exr in.exr -o . --dump-ghosts g.toml", {"in.exr"}},
          {"in.exr -o o.exr --age 30", {"--age"}}}) {
        const std::string lens = words.find("--ghosts") != std::string::npos ||
                                         words.find("--preset") != std::string::npos
                                     ? kLens
                                     : " --lens heliar ";
        const Outcome outcome = run("flare " + words + lens);
        EXPECT_EQ(outcome.exit_code, 2) << words;
        EXPECT_TRUE(names_all(outcome.err, message)) << words;
        EXPECT_EQ(outcome.err.rfind("aureole: ", 0), 0U) << outcome.err;
        EXPECT_EQ(folder_.names(), std::vector<std::string>{"in.exr"}) << words;
    }
}

TEST_F(FlareErrors, DumpIsOfOnePicture) {
    write("s.0001.exr", lit_picture());
    write("s.0002.exr", lit_picture());
    const Outcome outcome =
        run("flare s.%04d.exr -o o.%04d.exr --frames 1-2 --dump-ghosts g.toml" + kFast);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(names_all(outcome.err, {"--dump-ghosts", "g.toml", "2"}));
}

TEST_F(FlareErrors, OptionsOfTheOtherObserverAreRefused) {
    for (const auto& [words, message] :
         {std::pair<std::string, std::vector<std::string>>{
              "glare in.exr --observer camera --age 30", {"--age", "--observer camera"}},
          {"glare in.exr --observer camera --preset vivid", {"--preset", "vivid"}},
          {"glare in.exr --observer camera --psf k.exr", {"--psf", "--observer camera"}},
          {"glare in.exr --observer camera --white-luminance 9", {"--white-luminance"}},
          {"glare in.exr --observer camera --preset blog --ghosts hybrid", {"--ghosts", "blog"}},
          {"glare in.exr --lens biotar", {"--lens", "--observer camera"}},
          {"glare in.exr --f-number 4", {"--f-number", "--observer camera"}},
          {"glare in.exr --blades 5", {"--blades", "--observer camera"}},
          {"glare in.exr --light 1,2,3", {"--light", "--observer camera"}},
          {"glare in.exr --ghosts matrix", {"--ghosts", "--observer camera"}},
          {"glare in.exr --tint 2", {"--tint", "--observer camera"}},
          {"glare in.exr --preset blog", {"--preset", "blog", "camera"}},
          {"psf --observer camera --pupil 4", {"--pupil", "--observer camera"}},
          {"psf --observer camera --component halo", {"--component", "--observer camera"}},
          {"psf --sensor 36x24", {"--sensor", "--observer camera"}}}) {
        const Outcome outcome = run(words + " -o out.exr");
        EXPECT_EQ(outcome.exit_code, 2) << words;
        EXPECT_TRUE(names_all(outcome.err, message)) << words;
    }
    EXPECT_FALSE(exists("out.exr"));
}

}  // namespace
}  // namespace aureole::cli
