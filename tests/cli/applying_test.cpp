// How glare is applied: layers, matte, threshold, gain, foreign kernels. Laws, on any kernel.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "program.h"

namespace aureole::cli {
namespace {

constexpr int kWidth = 24;
constexpr int kHeight = 18;

// a + sign * b
Image combined(const Image& a, const Image& b, float sign) {
    Image result = a;
    for (int c = 0; c < a.channels(); ++c) {
        for (std::size_t i = 0; i < a.pixels(); ++i) result.plane(c)[i] += sign * b.plane(c)[i];
    }
    return result;
}

class Applying : public CliTest {
  protected:
    void SetUp() override {
        write("k.exr", soft_kernel(31));
        write("in.exr", in);
    }
    Image glare(const std::string& options, const std::string& name = "in.exr") const {
        const Outcome outcome = run("glare " + name + " -o out.exr --psf k.exr " + options);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return read("out.exr").image();
    }
    const Image in = noise(kWidth, kHeight, 3);
    const double tolerance = 1e-6 * largest(in);
};

TEST_F(Applying, MethodsAgree) {
    EXPECT_LT(largest_difference(glare("--method fft"), glare("--method direct")), tolerance);
    EXPECT_LT(largest_difference(glare("--fov 90"), glare("--fov 90 --method direct")),
              4 * tolerance);
}

// Sum of |a - b| over the sum of |b|.
double sum_of_differences(const Image& a, const Image& b) {
    double difference = 0;
    double sum = 0;
    for (int c = 0; c < b.channels(); ++c) {
        for (std::size_t i = 0; i < b.pixels(); ++i) {
            difference += std::abs(static_cast<double>(a.plane(c)[i]) - b.plane(c)[i]);
            sum += std::abs(static_cast<double>(b.plane(c)[i]));
        }
    }
    return difference / sum;
}

TEST_F(Applying, ApproximateMethodsStayWithinTheErrorAskedFor) {
    const Image exact = glare("--perspective off");
    for (const std::string method : {"sprites", "hybrid", "auto"}) {
        for (const double error : {0.05, 0.001}) {
            const Outcome outcome =
                run("glare in.exr -o out.exr --psf k.exr --perspective off --json --method " +
                    method + " --cluster-error " + std::to_string(error));
            ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
            EXPECT_LE(sum_of_differences(read("out.exr").image(), exact), error) << method;
            const auto json = nlohmann::json::parse(outcome.out);
            if (method == "hybrid") {  // a kernel as small as this has no far part
                EXPECT_EQ(json["method"], "fft");
                EXPECT_NE(outcome.err.find("note: --method hybrid"), std::string::npos);
            } else {
                EXPECT_LE(json["method_choice"]["error_bound"], error);
                EXPECT_GT(json["method_choice"]["actual_seconds"][json["method"]], 0);
            }
            if (method == "sprites") {
                EXPECT_EQ(json["method"], method);
                EXPECT_EQ(json["method_choice"]["reason"], "asked");
            }
            if (method == "auto") {
                EXPECT_GT(json["method_choice"]["predicted_seconds"]["fft"], 0);
            }
            const auto& energy = json["energy"];
            EXPECT_NEAR((energy["out"].get<double>() + energy["off_picture"].get<double>()) /
                            energy["in"].get<double>(),
                        1, error);
        }
    }
}

TEST_F(Applying, GlareLayerAndInputSumToTheComposite) {
    const Image composite = glare("");
    const Image layer = glare("--output-layers glare");
    EXPECT_LT(largest_difference(combined(layer, in, 1), composite), tolerance);
    EXPECT_GT(largest(layer), 1);
}

TEST_F(Applying, BothLayersAreThoseOfTheTwo) {
    const Image composite = glare("");
    const Image layer = glare("--output-layers glare");
    glare("--output-layers both");
    const io::Picture both = read("out.exr");
    EXPECT_EQ(both.image().channels(), 6);
    int c = 0;
    for (const std::string& name : {std::string("R"), std::string("G"), std::string("B")}) {
        EXPECT_TRUE(identical(channel(both, name), copy(composite.view().channel_range(c, 1))));
        EXPECT_TRUE(
            identical(channel(both, "glare." + name), copy(layer.view().channel_range(c, 1))));
        ++c;
    }
}

TEST_F(Applying, SurroundingsKeepAFlatFieldFlat) {
    const Image flat = constant(kWidth, kHeight, 3, 5);
    write("flat.exr", flat);
    EXPECT_GT(largest_difference(glare("--fov 70", "flat.exr"), flat), 0.5);
    EXPECT_LT(largest_difference(glare("--fov 70 --surround same", "flat.exr"), flat), 1e-5);
}

TEST_F(Applying, BlackMatteChangesNothing) {
    write("matte.exr", constant(kWidth, kHeight, 1, 0), {"Y"});
    EXPECT_TRUE(identical(glare("--matte matte.exr"), in));
}

TEST_F(Applying, WhiteMatteIsNoMatte) {
    write("matte.exr", constant(kWidth, kHeight, 1, 1), {"Y"});
    EXPECT_LT(largest_difference(glare("--matte matte.exr"), glare("")), tolerance);
}

// Glare of a matte is that of the light it lets through: out - in is the same as for a picture of
// that light alone.
TEST_F(Applying, MatteLimitsWhichPixelsMakeGlare) {
    Image matte(kWidth, kHeight, 1);
    Image light(kWidth, kHeight, 3);
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth / 2; ++x) {
            matte.at(x, y) = x % 2 == 0 ? 1.0F : 0.25F;
            for (int c = 0; c < 3; ++c) light.at(x, y, c) = matte.at(x, y) * in.at(x, y, c);
        }
    }
    write("matte.exr", matte, {"Y"});
    write("light.exr", light);
    const Image by_matte = combined(glare("--matte matte.exr"), in, -1);
    const Image alone = combined(glare("", "light.exr"), light, -1);
    EXPECT_LT(largest_difference(by_matte, alone), tolerance);
}

TEST_F(Applying, MatteOfAnotherSizeIsRefused) {
    write("matte.exr", constant(kWidth + 1, kHeight, 1, 1), {"Y"});
    const Outcome outcome = run("glare in.exr -o out.exr --psf k.exr --matte matte.exr");
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_TRUE(names_all(outcome.err, {"matte.exr", "25x18", "24x18"}));
    EXPECT_FALSE(exists("out.exr"));
}

TEST_F(Applying, PictureBelowTheThresholdIsReturnedUnchanged) {
    EXPECT_TRUE(identical(glare("--threshold 1e4"), in));
}

// The ramp max(0, v - t): out - in is the glare of what lies above.
TEST_F(Applying, ThresholdIsAContinuousRamp) {
    Image light = in;
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < light.pixels(); ++i) {
            light.plane(c)[i] = std::max(0.0F, light.plane(c)[i] - 50);
        }
    }
    write("light.exr", light);
    const Image above = combined(glare("--threshold 50"), in, -1);
    const Image alone = combined(glare("", "light.exr"), light, -1);
    EXPECT_LT(largest_difference(above, alone), tolerance);
}

TEST_F(Applying, GainZeroReturnsThePicture) { EXPECT_TRUE(identical(glare("--gain 0"), in)); }

TEST_F(Applying, GainScalesWhatGlareAddsAndTakesAway) {
    Image twice = combined(glare(""), in, -1);
    twice = combined(twice, twice, 1);
    EXPECT_LT(largest_difference(combined(glare("--gain 2"), in, -1), twice), 2 * tolerance);
}

// Nothing is normalised: a kernel of sum 1/2 halves a picture of wide flat light.
TEST_F(Applying, ForeignKernelIsTakenAsItIs) {
    write("k.exr", constant(3, 3, 3, 0.5F / 9));
    write("flat.exr", constant(9, 9, 3, 8));
    EXPECT_NEAR(glare("--perspective off", "flat.exr").at(4, 4), 4, 1e-5);
    write("grey.exr", constant(3, 3, 1, 0.5F / 9), {"Y"});
    const Outcome outcome = run("glare flat.exr -o out.exr --psf grey.exr --perspective off");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(read("out.exr").image().at(4, 4, c), 4, 1e-5);
}

// A kernel that says "one to the right" moves light to the right, not to the left.
TEST_F(Applying, KernelIsNotMirrored) {
    write("k.exr", point(5, 3, 3, 4, 1, 1));
    write("dot.exr", point(16, 12, 3, 6, 6, 3));
    const Image out = glare("--perspective off", "dot.exr");
    EXPECT_NEAR(out.at(8, 6), 3, 1e-5);
    EXPECT_NEAR(out.at(4, 6), 0, 1e-5);
}

TEST_F(Applying, KernelLargerThanThePictureWorks) {
    write("k.exr", soft_kernel(101));
    EXPECT_LT(largest_difference(glare(""), glare("--method direct")), tolerance);
}

TEST_F(Applying, EvenKernelIsRefused) {
    write("k.exr", constant(4, 3, 3, 1));
    const Outcome outcome = run("glare in.exr -o out.exr --psf k.exr");
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_TRUE(names_all(outcome.err, {"k.exr", "4x3", "odd"}));
}

TEST_F(Applying, KernelWithNonfiniteValuesIsRefused) {
    Image kernel = soft_kernel(5);
    kernel.at(1, 1, 0) /= 0.0F;
    write("k.exr", kernel);
    const Outcome outcome = run("glare in.exr -o out.exr --psf k.exr");
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_TRUE(names_all(outcome.err, {"k.exr", "finite"}));
}

TEST_F(Applying, ResultsDoNotDependOnThreads) {
    EXPECT_TRUE(identical(glare("--threads 1"), glare("--threads 2")));
}

}  // namespace
}  // namespace aureole::cli
