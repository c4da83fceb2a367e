#include "aureole/io/display_transform.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <cmath>
#include <functional>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/color/rgb.h"
#include "io/test_support.h"

namespace aureole::io {
namespace {

using testing::HasSubstr;

Image grey_ramp(const std::vector<float>& values) {
    Image image(static_cast<int>(values.size()), 1, 3);
    for (int c = 0; c < 3; ++c) std::copy(values.begin(), values.end(), image.plane(c));
    return image;
}

// The neutral axis of the ACES 1.0 SDR output transform; equal components within a hundredth of an
// 8-bit step: no tint on white.
TEST(AcesTransform, MatchesPublishedNeutrals) {
    Image image = grey_ramp({0, 0.18F, 1, 16.3F});
    DisplayTransform::aces().apply(image, image, 1);
    const double expected[] = {0, 0.35595, 0.81197, 1.00001};
    for (int x = 0; x < 4; ++x) {
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(image.at(x, 0, c), expected[x], 1e-5) << x;
            EXPECT_NEAR(image.at(x, 0, c), image.at(x, 0, 0), 4e-5) << x;
        }
    }
}

TEST(AcesTransform, ScalesByExposureFirst) {
    Image image = grey_ramp({0.045F});
    DisplayTransform::aces().apply(image, image, 4);
    EXPECT_NEAR(image.at(0, 0), 0.35595, 1e-5);
}

TEST(AcesTransform, DesaturatesBrightColors) {
    Image image(2, 1, 3);
    image.at(0, 0, 2) = 1;
    image.at(1, 0, 2) = 1000;
    DisplayTransform::aces().apply(image, image, 1);
    EXPECT_LT(image.at(0, 0, 0), 0.3);
    EXPECT_GT(image.at(1, 0, 0), 0.6);
}

// Same pixels in either layout, wider than one chunk, on any number of threads.
TEST(DisplayTransform, DoesNotDependOnLayoutOrThreads) {
    const Image image = noise(2500, 5, 3);
    const DisplayTransform aces = DisplayTransform::aces();
    Image planar(2500, 5, 3);
    aces.apply(image, planar, 1);
    std::vector<float> memory(2500UL * 5 * 3);
    const ImageView interleaved = interleaved_view(memory.data(), 2500, 5, 3);
    const ThreadLimit one(1);
    aces.apply(image, interleaved, 1);
    for (int x = 0; x < 2500; ++x) {
        for (int c = 0; c < 3; ++c) ASSERT_EQ(interleaved.at(x, 4, c), planar.at(x, 4, c));
    }
}

constexpr const char* kConfig = R"(ocio_profile_version: 2
roles:
  default: raw
  scene_linear: linear
displays:
  Monitor:
    - !<View> {name: Film, colorspace: squared}
    - !<View> {name: Raw, colorspace: linear}
  Projector:
    - !<View> {name: Dark, colorspace: linear}
active_displays: [Monitor, Projector]
active_views: [Film, Raw, Dark]
colorspaces:
  - !<ColorSpace>
    name: raw
    isdata: true
  - !<ColorSpace>
    name: linear
  - !<ColorSpace>
    name: squared
    from_scene_reference: !<ExponentTransform> {value: [2, 2, 2, 1]}
  - !<ColorSpace>
    name: half
    to_scene_reference: !<MatrixTransform> {matrix: [0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 1]}
)";

class OcioTransform : public testing::Test {
  protected:
    OcioTransform() { write_bytes(settings_.config, kConfig); }
    float apply(float value) const {
        Image image = grey_ramp({value});
        DisplayTransform::ocio(settings_).apply(image, image, 1);
        return image.at(0, 0, 1);
    }
    std::string message() const {
        try {
            DisplayTransform::ocio(settings_);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }
    TemporaryFolder folder_;
    OcioSettings settings_{folder_.file("config.ocio"), "", "", ""};
};

TEST_F(OcioTransform, DefaultsToSceneLinearAndTheFirstView) {
    EXPECT_NEAR(apply(0.5F), 0.25, 1e-6);
}

TEST_F(OcioTransform, TakesSpaceDisplayAndView) {
    settings_.input_space = "half";
    EXPECT_NEAR(apply(0.5F), 0.0625, 1e-6);
    settings_.view = "Raw";
    EXPECT_NEAR(apply(0.5F), 0.25, 1e-6);
    settings_.display = "Projector";
    settings_.view = "";
    settings_.input_space = "linear";
    EXPECT_NEAR(apply(0.5F), 0.5, 1e-6);
}

TEST_F(OcioTransform, ReadsTheEnvironment) {
    ::setenv("OCIO", settings_.config.c_str(), 1);
    settings_.config.clear();
    EXPECT_NEAR(apply(0.5F), 0.25, 1e-6);
    ::unsetenv("OCIO");
    EXPECT_THROW(apply(0.5F), FileError);
    EXPECT_THAT(message(), HasSubstr("OCIO"));
}

TEST_F(OcioTransform, NamesWhatIsOffered) {
    settings_.display = "Cinema";
    EXPECT_THAT(message(), testing::AllOf(HasSubstr("Cinema"), HasSubstr("\"Monitor\""),
                                          HasSubstr("\"Projector\"")));
    settings_.display = "Projector";
    settings_.view = "Film";
    EXPECT_THAT(message(), testing::AllOf(HasSubstr("Film"), HasSubstr("\"Dark\"")));
    settings_.view.clear();
    settings_.input_space = "ACEScg";
    EXPECT_THAT(message(), testing::AllOf(HasSubstr("ACEScg"), HasSubstr("\"squared\""),
                                          HasSubstr("\"scene_linear\"")));
    EXPECT_THROW(apply(0.5F), InvalidArgument);
}

TEST_F(OcioTransform, RefusesMissingAndDamagedFiles) {
    settings_.config = folder_.file("missing.ocio");
    EXPECT_THROW(apply(0.5F), FileError);
    EXPECT_THAT(message(), HasSubstr("missing.ocio"));
    settings_.config = folder_.file("bad.ocio");
    write_bytes(settings_.config, "not a configuration");
    EXPECT_THROW(apply(0.5F), FileError);
}

}  // namespace
}  // namespace aureole::io
