// --resolution: what is far away on a raster.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "program.h"

namespace aureole::cli {
namespace {

using ReducedResolution = CliTest;

// Sum of |a - b| over the sum of b.
double relative_difference(const Image& a, const Image& b) {
    double difference = 0;
    double sum = 0;
    for (int c = 0; c < b.channels(); ++c) {
        for (std::size_t i = 0; i < b.pixels(); ++i) {
            difference += std::abs(static_cast<double>(a.plane(c)[i]) - b.plane(c)[i]);
            sum += static_cast<double>(b.plane(c)[i]);
        }
    }
    return difference / sum;
}

TEST_F(ReducedResolution, IsCloseToFullAndSaysHowClose) {
    write("in.exr", noise(300, 280, 3));
    const std::string words = "glare in.exr -o out.exr --fov 35 --pupil 3";
    const auto full = report(words);
    EXPECT_EQ(full["parameters"]["resolution"], "full");
    EXPECT_EQ(full.count("raster"), 0U);
    const Image exact = read("out.exr").image();
    for (const std::string name : {"half", "quarter"}) {
        const auto json = report(words + " --resolution " + name);
        EXPECT_EQ(json["parameters"]["resolution"], name);
        EXPECT_EQ(json["method"], "fft");
        EXPECT_EQ(json["raster"]["scale"], name == "half" ? 2 : 4);
        const double bound = json["raster"]["error_bound"];
        EXPECT_GT(bound, 0);
        EXPECT_LE(bound, 1e-3);
        EXPECT_LE(relative_difference(read("out.exr").image(), exact), 1.1 * bound);
        const auto& energy = json["energy"];
        EXPECT_NEAR((energy["out"].get<double>() + energy["off_picture"].get<double>()) /
                        energy["in"].get<double>(),
                    1, 1e-5);
    }
}

TEST_F(ReducedResolution, IsNotedWhereItIsFull) {
    write("in.exr", noise(40, 30, 3));
    write("k.exr", soft_kernel(9));
    const Outcome outcome = run("glare in.exr -o out.exr --psf k.exr --resolution half --json");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(names_all(outcome.err, {"--resolution half", "full resolution"}));
    EXPECT_FALSE(nlohmann::json::parse(outcome.out).contains("raster"));
}

}  // namespace
}  // namespace aureole::cli
