// Pictures that people made, from the folder AUREOLE_TEST_IMAGES; skipped where it is not.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "aureole/image/finite.h"
#include "program.h"

namespace aureole::cli {
namespace {

class RealPictures : public CliTest {
  protected:
    void SetUp() override {
        write("k.exr", soft_kernel(9));
        const char* const folder = std::getenv("AUREOLE_TEST_IMAGES");
        if (folder == nullptr) GTEST_SKIP() << "AUREOLE_TEST_IMAGES is not set";
        folder_of_pictures = folder;
    }
    // The path, or a skipped test.
    std::string picture(const std::string& name) const {
        std::string path = folder_of_pictures + "/" + name;
        return std::filesystem::exists(path) ? path : "";
    }
    std::string folder_of_pictures;
};

TEST_F(RealPictures, NonfiniteValuesAreReplacedAndCounted) {
    const std::string path = picture("bright_rings_nan_inf.exr");
    if (path.empty()) GTEST_SKIP() << "no bright_rings_nan_inf.exr";
    io::Picture in = io::read_picture(path);
    const std::size_t bad = replace_nonfinite(in.color());
    EXPECT_GT(bad, 0U);
    EXPECT_EQ(report("glare " + path + " -o out.exr --psf k.exr")["nonfinite_pixels"], bad);
    io::Picture out = read("out.exr");
    EXPECT_EQ(replace_nonfinite(out.color()), 0U);
}

// All other channels of a render with many layers come out as they went in, and the light that the
// kernel moved is still there.
TEST_F(RealPictures, KeepTheirChannelsAndTheirLight) {
    for (const char* name : {"still_life.exr", "venice_sunset_1k.hdr"}) {
        const std::string path = picture(name);
        if (path.empty()) GTEST_SKIP() << "no " << name;
        const auto energy = report("glare " + path + " -o out.exr --psf k.exr")["energy"];
        const double in = energy["in"];
        EXPECT_NEAR((energy["out"].get<double>() + energy["off_picture"].get<double>()) / in, 1,
                    1e-4);
        const io::Picture before = io::read_picture(path);
        const io::Picture after = read("out.exr");
        EXPECT_EQ(before.display_window(), after.display_window());
        EXPECT_EQ(before.other_parts(), after.other_parts());
        ASSERT_EQ(before.channel_names(), after.channel_names());
        for (int c = before.color_channels(); c < before.image().channels(); ++c) {
            EXPECT_TRUE(identical(copy(before.image().view().channel_range(c, 1)),
                                  copy(after.image().view().channel_range(c, 1))))
                << before.channel_names()[static_cast<std::size_t>(c)];
        }
    }
}

TEST_F(RealPictures, GoThroughEveryMethodAndToneMap) {
    const std::string path = picture("still_life.exr");
    if (path.empty()) GTEST_SKIP() << "no still_life.exr";
    ASSERT_EQ(run("glare " + path + " -o fft.exr --psf k.exr --method fft").exit_code, 0);
    ASSERT_EQ(run("glare " + path + " -o direct.exr --psf k.exr --method direct").exit_code, 0);
    const io::Picture fft = read("fft.exr");
    const io::Picture direct = read("direct.exr");
    EXPECT_LT(largest_difference(fft.color(), direct.color()), 1e-5 * largest(direct.color()));
    for (const char* curve : {"none", "narkowicz", "hill", "aces", "xyz"}) {
        const Outcome outcome =
            run("glare " + path + " -o out.png --psf k.exr --tone-map " + curve);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(read("out.png").image().width(), fft.display_window().width);
    }
}

}  // namespace
}  // namespace aureole::cli
