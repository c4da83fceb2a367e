// What artists change about ghosts, and cameras as observers of `aureole glare` and `aureole psf`.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "flare_pictures.h"

namespace aureole::cli {
namespace {

using FlareLooks = Flare;
using CameraGlare = Flare;

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos;
         at = text.find(from, at + to.size())) {
        text.replace(at, from.size(), to);
    }
    return text;
}

TEST_F(FlareLooks, BlogIsMatrixAndSameSide) {
    const auto json = report("flare in.exr -o out.exr --preset blog" + kLens);
    EXPECT_EQ(json["method"], "matrix");
    EXPECT_EQ(json["parameters"]["preset"], "blog");
    EXPECT_EQ(json["parameters"]["pairs"], "same-side");
    EXPECT_GT(json["energy"]["ghosts"].get<double>(), 0);
    EXPECT_LT(json["ghosts"]["count"].get<int>(),
              report("flare in.exr -o out.exr" + kFast)["ghosts"]["count"].get<int>());
}

TEST_F(FlareLooks, GhostsBrighterThanThePictureAreTold) {
    const Outcome bright = run("flare in.exr -o out.exr --tint 1e5" + kFast);
    EXPECT_TRUE(names_all(bright.err, {"note: ghosts hold", "--tint"}));
    const Outcome physical = run("flare in.exr -o out.exr" + kFast);
    EXPECT_EQ(physical.err.find("ghosts hold"), std::string::npos);
}

TEST_F(FlareLooks, TintScales) {
    const double all = ghosts(kFast);
    EXPECT_NEAR(ghosts(" --tint 0.5" + kFast) / all, 0.5, 1e-4);
    ASSERT_EQ(run("flare in.exr -o red.exr --only --tint 1,0,0" + kFast).exit_code, 0);
    ASSERT_EQ(run("flare in.exr -o all.exr --only" + kFast).exit_code, 0);
    const Image red = read("red.exr").image();
    EXPECT_EQ(largest(red.view().channel_range(1, 2)), 0);
    EXPECT_GT(largest(red.view().channel_range(0, 1)), 0);
}

TEST_F(FlareLooks, DumpedAndReadBackChangeNothing) {
    ASSERT_EQ(run("flare in.exr -o a.exr --dump-ghosts g.toml" + kLens).exit_code, 0);
    const auto json = report("flare in.exr -o b.exr --ghosts-from g.toml" + kLens);
    EXPECT_TRUE(identical(read("a.exr").image(), read("b.exr").image()));
    const std::string text = bytes("g.toml");
    std::size_t count = 0;
    for (std::size_t at = text.find("[[ghost]]"); at != std::string::npos;
         at = text.find("[[ghost]]", at + 1)) {
        ++count;
    }
    EXPECT_EQ(json["ghosts"]["count"], count);
    EXPECT_TRUE(names_all(text, {"surfaces = [", "enabled = true", "gain = 1.0",
                                 "tint = [1.0, 1.0, 1.0]", "# ", "% of the energy"}));
}

// --dump-ghosts needs no picture to be written, and tells the settings in force.
TEST_F(FlareLooks, DumpAlone) {
    ASSERT_EQ(run("flare in.exr --dump-ghosts g.toml" + kFast).exit_code, 0);
    write_bytes("h.toml", replaced(bytes("g.toml"), "gain = 1.0", "gain = 0.25"));
    ASSERT_EQ(run("flare in.exr --ghosts-from h.toml --dump-ghosts i.toml" + kFast).exit_code, 0);
    EXPECT_TRUE(names_all(bytes("i.toml"), {"gain = 0.25"}));
    EXPECT_EQ(bytes("i.toml").find("gain = 1.0"), std::string::npos);
    EXPECT_EQ(folder_.names(), (std::vector<std::string>{"g.toml", "h.toml", "i.toml", "in.exr"}));
}

TEST_F(FlareLooks, EditedGhostsObey) {
    const double all = ghosts(" --dump-ghosts g.toml" + kFast);
    const std::string text = bytes("g.toml");
    const auto edited = [&](const std::string& from, const std::string& to) {
        write_bytes("e.toml", replaced(text, from, to));
        return ghosts(" --ghosts-from e.toml" + kFast);
    };
    EXPECT_NEAR(edited("gain = 1.0", "gain = 2.0") / all, 2, 1e-4);
    EXPECT_NEAR(edited("tint = [1.0, 1.0, 1.0]", "tint = [0.5, 0.5, 0.5]") / all, 0.5, 1e-4);
    EXPECT_EQ(edited("enabled = true", "enabled = false"), 0);
    // One ghost alone, by its name: the strongest is the first in the file.
    const std::string first = text.substr(text.find("[[ghost]]"));
    write_bytes("e.toml",
                replaced(first.substr(0, first.find("\n\n")), "enabled = true", "enabled = false"));
    const double without = ghosts(" --ghosts-from e.toml" + kFast);
    EXPECT_LT(without, all);
    EXPECT_GT(without, 0);
}

// One pass: the star of the iris, then the ghosts.
TEST_F(CameraGlare, IsFlareWithAStarburst) {
    ASSERT_EQ(run("flare in.exr -o flare.exr --starburst --blades 6" + kLens).exit_code, 0);
    const auto json = report("glare in.exr -o glare.exr --observer camera --blades 6" + kLens);
    EXPECT_TRUE(identical(read("flare.exr").image(), read("glare.exr").image()));
    EXPECT_EQ(json["method"], "fft");
    EXPECT_EQ(json["parameters"]["observer"], "camera");
    EXPECT_EQ(json["parameters"]["starburst"], true);
    EXPECT_GT(json["energy"]["ghosts"].get<double>(), 0);
    EXPECT_GT(json["energy"]["off_picture"].get<double>(), 0);
}

// The kernel that psf writes is the one that glare applies.
TEST_F(CameraGlare, AppliesTheKernelOfPsf) {
    const std::string camera = " --observer camera --blades 5" + kLens;
    const auto json = report("psf -o star.exr --width 96 --height 64 --size 191 --fov 30" + camera);
    double sum = 0;
    const Image kernel = read("star.exr").image();
    for (std::size_t i = 0; i < kernel.pixels(); ++i) sum += double{kernel.plane(1)[i]};
    EXPECT_NEAR(sum + json["energy"]["off_kernel"][1].get<double>(), 1, 1e-4);
    EXPECT_GT(kernel.at(95, 95, 1), kernel.at(95, 90, 1));
    ASSERT_EQ(run("glare in.exr -o a.exr --tint 0" + camera).exit_code, 0);
    ASSERT_EQ(run("glare in.exr -o b.exr --psf star.exr").exit_code, 0);
    const Image a = read("a.exr").image();
    EXPECT_LT(largest_difference(a, read("b.exr").image()), 1e-5 * largest(a));
}

TEST_F(CameraGlare, HasADefaultLensAndSaysSo) {
    const Outcome outcome = run("glare in.exr -o out.exr --observer camera");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(names_all(outcome.err, {"note", "heliar", "--lens"}));
}

}  // namespace
}  // namespace aureole::cli
