// A star that drifts over a picture whose glare is computed at reduced resolution must not flicker,
// nor what it sends far away move in steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "aureole/base/random.h"
#include "aureole/eye/eye_psf.h"
#include "aureole/glare/glare.h"
#include "aureole/image/view.h"

namespace aureole {
namespace {

using glare::Resolution;

constexpr int kWidth = 768;
constexpr int kHeight = 528;
constexpr double kStartX = 380.3;
constexpr double kStartY = 260.8;
constexpr int kPixel = 16;  // frames
constexpr int kFrames = 6 * kPixel;
constexpr float kEnergy = 1e5F;

// The pitch of 1920 pixels over 60 deg.
View view() { return View::from_fov(kWidth, kHeight, kWidth / 32.0, Projection::kConstantPitch); }

struct DriftCase {
    std::string psf;
    Resolution resolution = Resolution::kFull;
};

// The eye's, with its needles; or smooth wings with six streaks.
const wave::Psf& psf_of(const DriftCase& drift) {
    static const wave::Psf eye = eye::eye_psf(eye::Eye{}, wave::KernelGrid::full_reach(view()));
    static const wave::Psf smooth = [] {
        wave::Psf psf;
        psf.grid = wave::KernelGrid::full_reach(view());
        psf.kernel = Image(psf.grid.width, psf.grid.height, 3);
        for (int y = 0; y < psf.grid.height; ++y) {
            for (int x = 0; x < psf.grid.width; ++x) {
                const double dx = x - psf.grid.width / 2;
                const double dy = y - psf.grid.height / 2;
                const double streak = std::pow(std::cos(3 * std::atan2(dy, dx)), 20);
                const double k = 0.05 * (1 + streak) / std::pow(0.3 + dx * dx + dy * dy, 1.15);
                for (int c = 0; c < 3; ++c) psf.kernel.at(x, y, c) = static_cast<float>(k);
            }
        }
        return psf;
    }();
    return drift.psf == "eye" ? eye : smooth;
}

// A star of one pixel at the continuous position (x, y), as area coverage draws it.
void add_star(Image& image, double x, double y) {
    const int left = static_cast<int>(std::floor(x - 0.5));
    const int top = static_cast<int>(std::floor(y - 0.5));
    const double fx = x - 0.5 - left;
    const double fy = y - 0.5 - top;
    image.at(left, top) += static_cast<float>((1 - fx) * (1 - fy)) * kEnergy;
    image.at(left + 1, top) += static_cast<float>(fx * (1 - fy)) * kEnergy;
    image.at(left, top + 1) += static_cast<float>((1 - fx) * fy) * kEnergy;
    image.at(left + 1, top + 1) += static_cast<float>(fx * fy) * kEnergy;
}

double x_of(int frame) { return kStartX + static_cast<double>(frame) / kPixel; }
double y_of(int frame) { return kStartY + static_cast<double>(frame) / kPixel; }

// 1/16 pixel a frame along a diagonal, over a dim textured ground.
class Drift : public testing::TestWithParam<DriftCase> {
  protected:
    Drift() : glare_(at(GetParam().resolution)), ground_(kWidth, kHeight, 1) {
        Random random(6);
        for (std::size_t i = 0; i < ground_.pixels(); ++i) {
            ground_.plane(0)[i] = static_cast<float>(random.uniform(0, 2));
        }
    }

    // None of these kernels needs full resolution.
    void SetUp() override {
        frame(0, glare_);
        ASSERT_EQ(glare_.last().raster.scale > 1, GetParam().resolution != Resolution::kFull);
    }

    static glare::Glare at(Resolution resolution) {
        glare::GlareOptions options;
        options.resolution = resolution;
        return {view(), 1, psf_of(GetParam()), options};
    }

    Image frame(int index, glare::Glare& glare) const {
        Image image = ground_;
        add_star(image, x_of(index), y_of(index));
        glare.apply(image, image);
        return image;
    }

    glare::Glare glare_;
    Image ground_;
};

double sum_of(const Image& image) {
    double sum = 0;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        sum += static_cast<double>(image.plane(0)[i]);
    }
    return sum;
}

// Middle of the light of 3 x 3 pixels about the brightest, above the mean of those around them.
std::pair<double, double> peak_of(const Image& image) {
    const auto most = std::max_element(image.plane(0), image.plane(0) + image.pixels());
    const auto at = static_cast<int>(most - image.plane(0));
    const int px = at % image.width();
    const int py = at / image.width();
    double around = 0;
    for (int i = -2; i < 2; ++i) {
        for (const auto& [u, v] : {std::pair{i, -2}, {2, i}, {-i, 2}, {-2, -i}}) {
            around += static_cast<double>(image.at(px + u, py + v)) / 16;
        }
    }
    double sum = 0;
    double x = 0;
    double y = 0;
    for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
            const double value = static_cast<double>(image.at(px + i, py + j)) - around;
            sum += value;
            x += value * (px + i + 0.5);
            y += value * (py + j + 0.5);
        }
    }
    return {x / sum, y / sum};
}

TEST_P(Drift, KeepsEnergyAndPeakPosition) {
    const double first = sum_of(frame(0, glare_));
    double most_energy = 0;
    double most_distance = 0;
    for (int i = 0; i < kFrames; ++i) {
        const Image image = frame(i, glare_);
        most_energy = std::max(most_energy, std::abs(sum_of(image) / first - 1));
        const auto [x, y] = peak_of(image);
        most_distance = std::max({most_distance, std::abs(x - x_of(i)), std::abs(y - y_of(i))});
    }
    EXPECT_LE(most_energy, 0.005);
    EXPECT_LE(most_distance, 0.125);
    RecordProperty("energy", std::to_string(most_energy));
    RecordProperty("distance", std::to_string(most_distance));
}

// No pixel differs visibly from full resolution, in any frame.
TEST_P(Drift, LooksAsAtFullResolution) {
    glare::Glare full = at(Resolution::kFull);
    for (int i = 0; i < kFrames; i += 5) {
        const Image image = frame(i, glare_);
        const Image exact = frame(i, full);
        for (std::size_t p = 0; p < image.pixels(); ++p) {
            ASSERT_NEAR(image.plane(0)[p] / exact.plane(0)[p], 1, 0.002);
        }
    }
}

// Seen from a pixel far away the star comes steadily nearer, or goes: its light there grows or
// falls, pixel of drift by pixel of drift as at full resolution. Blocks of a raster that moved as
// such would stand still for a pixel or more, and then make up for all of it at once.
TEST_P(Drift, ChangesWhatIsFarAwaySmoothly) {
    // Of the transforms, at full resolution as well.
    constexpr double kRounding = 4e-9 * static_cast<double>(kEnergy);
    struct Probe {
        int dx;
        int dy;
    };
    std::vector<Probe> probes;
    for (const int distance : {20, 31, 44, 57, 73, 100, 160, 210}) {
        // Ahead and behind, and between the streaks, which lie on multiples of 60 deg.
        probes.push_back({distance * 7 / 10, distance * 7 / 10});
        probes.push_back({-distance * 7 / 10, -distance * 7 / 10});
        probes.push_back({2, distance});
        probes.push_back({-3, -distance});
    }
    glare::Glare full = at(Resolution::kFull);
    std::vector<std::vector<double>> values(probes.size());
    std::vector<std::vector<double>> exact(probes.size());
    for (int i = 0; i < kFrames; ++i) {
        const auto look = [&](const Image& image, std::vector<std::vector<double>>& into) {
            for (std::size_t p = 0; p < probes.size(); ++p) {
                into[p].push_back(
                    static_cast<double>(image.at(static_cast<int>(kStartX) + probes[p].dx,
                                                 static_cast<int>(kStartY) + probes[p].dy)));
            }
        };
        look(frame(i, glare_), values);
        look(frame(i, full), exact);
    }
    for (std::size_t p = 0; p < probes.size(); ++p) {
        const std::vector<double>& v = values[p];
        const double sign = probes[p].dy > 0 ? 1 : -1;
        for (std::size_t i = 1; i < v.size() && GetParam().psf == "smooth"; ++i) {
            EXPECT_GT(sign * (v[i] - v[i - 1]), -kRounding);
        }
        for (std::size_t i = kPixel; i < v.size(); ++i) {
            const double expected = exact[p][i] - exact[p][i - kPixel];
            EXPECT_NEAR(v[i] - v[i - kPixel], expected, 0.1 * std::abs(expected) + kRounding)
                << probes[p].dx << " " << probes[p].dy;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    Of, Drift,
    testing::Values(DriftCase{"smooth", Resolution::kFull}, DriftCase{"smooth", Resolution::kHalf},
                    DriftCase{"smooth", Resolution::kQuarter}, DriftCase{"eye", Resolution::kHalf},
                    DriftCase{"eye", Resolution::kQuarter}),
    [](const auto& test_case) {
        return test_case.param.psf + "_" + std::string(name_of(test_case.param.resolution));
    });

}  // namespace
}  // namespace aureole
