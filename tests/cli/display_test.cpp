// Pictures for a display: tone maps, exposure, side by side, OpenColorIO.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "program.h"

namespace aureole::cli {
namespace {

// 8-bit samples of a file, interleaved.
struct Samples {
    int channels = 0;
    std::vector<unsigned char> values;
};

class Display : public CliTest {
  protected:
    void SetUp() override {
        write("one.exr", constant(1, 1, 3, 1));
        write("in.exr", ramp());
    }
    // Grey columns from 1e-3 to 1e4.
    static Image ramp() {
        Image image(64, 8, 3);
        for (int c = 0; c < 3; ++c) {
            for (int y = 0; y < 8; ++y) {
                for (int x = 0; x < 64; ++x) {
                    image.at(x, y, c) = static_cast<float>(std::pow(10, -3 + x / 9.0));
                }
            }
        }
        return image;
    }
    Samples samples(const std::string& name) const {
        Samples result;
        const auto input = OIIO::ImageInput::open(file(name));
        if (!input) {
            ADD_FAILURE() << "cannot open " << name;
            return result;
        }
        result.channels = input->spec().nchannels;
        result.values.resize(input->spec().image_pixels() *
                             static_cast<std::size_t>(result.channels));
        EXPECT_TRUE(input->read_image(0, 0, 0, result.channels, OIIO::TypeDesc::UINT8,
                                      result.values.data()));
        return result;
    }
    Outcome show(const std::string& options, const Conditions& conditions = {}) const {
        return run("glare in.exr --psf one.exr " + options, conditions);
    }
};

TEST_F(Display, EveryToneMapKeepsWhiteNeutralAndRisesWithLight) {
    for (const std::string& name : {std::string("none"), std::string("narkowicz"),
                                    std::string("hill"), std::string("aces"), std::string("xyz")}) {
        const Outcome outcome = show("-o out.png --tone-map " + name);
        ASSERT_EQ(outcome.exit_code, 0) << name << outcome.err;
        const Samples out = samples("out.png");
        ASSERT_EQ(out.channels, 3) << name;
        for (std::size_t x = 0; x < 64; ++x) {
            const unsigned char* rgb = &out.values[3 * x];
            EXPECT_EQ(rgb[0], rgb[1]) << name << " column " << x;
            EXPECT_EQ(rgb[1], rgb[2]) << name << " column " << x;
            if (x > 0) {
                EXPECT_GE(rgb[0], rgb[-3]) << name << " column " << x;
            }
        }
        EXPECT_LT(out.values[0], 20) << name;
        EXPECT_GE(out.values[3 * 63], 250) << name;
    }
}

TEST_F(Display, NoneIsTheCurveOfSrgb) {
    write("in.exr", constant(4, 4, 3, 0.5F));
    ASSERT_EQ(show("-o out.png --tone-map none").exit_code, 0);
    EXPECT_EQ(samples("out.png").values[0], 188);  // 255 (1.055 .5^(1/2.4) - .055) = 187.5
}

TEST_F(Display, ExposureIsInStops) {
    write("in.exr", constant(4, 4, 3, 0.125F));
    ASSERT_EQ(show("-o out.png --tone-map none --exposure 2").exit_code, 0);
    EXPECT_EQ(samples("out.png").values[0], 188);
    io::Picture labelled(constant(4, 4, 3, 0.125F));
    labelled.set_attribute("aureole:exposure_ev", 2.0F);
    write("in.exr", labelled);
    ASSERT_EQ(show("-o out.png --tone-map none").exit_code, 0);
    EXPECT_EQ(samples("out.png").values[0], 188);
    ASSERT_EQ(show("-o out.png --tone-map none --exposure 3").exit_code, 0);
    EXPECT_EQ(samples("out.png").values[0], 255);
}

TEST_F(Display, AntialiasingSmoothsJaggedEdgesAndNothingElse) {
    Image jagged(32, 32, 3);
    for (int c = 0; c < 3; ++c) {
        for (int y = 0; y < 32; ++y) {
            for (int x = 0; x < 32; ++x) jagged.at(x, y, c) = 3 * x + y > 60 ? 1.0F : 0.0F;
        }
    }
    write("in.exr", jagged);
    show("-o plain.png --tone-map none");
    EXPECT_EQ(show("-o smooth.png --tone-map none --antialias edges").exit_code, 0);
    const Samples plain = samples("plain.png");
    const Samples smooth = samples("smooth.png");
    std::size_t between = 0;
    std::size_t changed = 0;
    for (std::size_t i = 0; i < plain.values.size(); ++i) {
        EXPECT_TRUE(plain.values[i] == 0 || plain.values[i] == 255);
        if (smooth.values[i] > 0 && smooth.values[i] < 255) ++between;
        if (smooth.values[i] != plain.values[i]) ++changed;
    }
    EXPECT_GT(between, 32U);
    EXPECT_LT(changed, plain.values.size() / 5);
}

TEST_F(Display, AntialiasingIsForDisplayFiles) {
    const Outcome outcome = show("-o out.exr --antialias edges");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(names_all(outcome.err, {"--antialias", "edges", "PNG"}));
}

TEST_F(Display, AlphaIsNotPartOfWhatIsShown) {
    write("in.exr", constant(4, 4, 4, 0.5F), {"R", "G", "B", "A"});
    ASSERT_EQ(show("-o out.png --tone-map none").exit_code, 0);
    EXPECT_EQ(samples("out.png").channels, 3);
    EXPECT_EQ(samples("out.png").values[0], 188);
}

TEST_F(Display, LinearFilesAreNotToneMapped) {
    ASSERT_EQ(show("-o out.png -o out.exr -o out.tif --tone-map hill --exposure 3").exit_code, 0);
    const Image in = ramp();
    EXPECT_LT(largest_difference(read("out.exr").image(), in), 1e-6 * largest(in));
    EXPECT_LT(largest_difference(read("out.tif").image(), in), 1e-6 * largest(in));
}

TEST_F(Display, SideBySideShowsBeforeAndAfter) {
    write("in.exr", constant(16, 12, 3, 0.5F));
    write("half.exr", constant(1, 1, 3, 0.25F));  // a glare that takes light away
    const Outcome outcome =
        run("glare in.exr -o out.png --psf half.exr --tone-map none --side-by-side both.png");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(names_all(outcome.out, {"out.png", "both.png"}));
    const auto input = OIIO::ImageInput::open(file("both.png"));
    ASSERT_TRUE(input);
    EXPECT_EQ(input->spec().width, 2 * 16 + 4);
    EXPECT_EQ(input->spec().height, 12);
    const Samples both = samples("both.png");
    EXPECT_EQ(both.values[0], 188);       // before
    EXPECT_EQ(both.values[3 * 17], 255);  // the line between
    EXPECT_EQ(both.values[3 * 20], 99);   // after: 0.125
    EXPECT_EQ(samples("out.png").values[0], 99);
}

TEST_F(Display, OcioWithoutAConfigurationIsAClearError) {
    const Outcome outcome = show("-o out.png --tone-map ocio", {{}, {{"OCIO", ""}}, ""});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_TRUE(names_all(outcome.err, {"OpenColorIO", "OCIO"}));
    EXPECT_FALSE(exists("out.png"));
}

TEST_F(Display, OcioConfigurationThatIsMissingIsNamed) {
    const Outcome outcome = show("-o out.png --tone-map ocio --ocio-config no.ocio");
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_TRUE(names_all(outcome.err, {"no.ocio"}));
}

TEST_F(Display, OcioUsesTheConfiguration) {
    write_bytes("studio.ocio",
                "ocio_profile_version: 1\n"
                "roles: {default: linear, scene_linear: linear}\n"
                "displays:\n"
                "  Monitor:\n"
                "    - !<View> {name: Half, colorspace: half}\n"
                "    - !<View> {name: Plain, colorspace: linear}\n"
                "colorspaces:\n"
                "  - !<ColorSpace> {name: linear}\n"
                "  - !<ColorSpace>\n"
                "    name: half\n"
                "    from_reference: !<MatrixTransform> {matrix: [0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, "
                "0, 0.5, 0, 0, 0, 0, 1]}\n");
    write("in.exr", constant(4, 4, 3, 0.8F));
    const std::string options = "-o out.png --tone-map ocio --ocio-config studio.ocio";
    const Outcome outcome = show(options);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(samples("out.png").values[0], 102);
    ASSERT_EQ(show(options + " --ocio-view Plain").exit_code, 0);
    EXPECT_EQ(samples("out.png").values[0], 204);
    ASSERT_EQ(
        show("-o out.png --tone-map ocio", {{}, {{"OCIO", file("studio.ocio")}}, ""}).exit_code, 0);
    EXPECT_EQ(samples("out.png").values[0], 102);
    const Outcome wrong = show(options + " --ocio-view Film");
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_TRUE(names_all(wrong.err, {"Film", "Half", "Plain"}));
}

TEST_F(Display, SceneWritesBothKinds) {
    const Outcome outcome =
        run("scene bars --width 64 --height 36 -o bars.exr -o bars.png --tone-map xyz");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(samples("bars.png").values.size(), 64UL * 36 * 3);
    EXPECT_GT(read("bars.exr").float_attribute("aureole:fov_deg").value_or(0), 0);
    EXPECT_GT(read("bars.exr").float_attribute("aureole:adaptation_cd_m2").value_or(0), 0);
}

}  // namespace
}  // namespace aureole::cli
