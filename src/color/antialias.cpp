#include "aureole/color/antialias.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/color/rgb.h"

namespace aureole::color {
namespace {

constexpr float kLeastContrast = 1.0F / 16;
constexpr float kFullContrast = 1.0F / 4;
constexpr int kTaps = 2;  // on either side
constexpr std::array<float, kTaps + 1> kWeights = {6.0F / 16, 4.0F / 16, 1.0F / 16};

// A picture that goes on beyond its border as it ends there.
class Clamped {
  public:
    explicit Clamped(const ConstImageView& view) : view_(view) {}

    float at(int x, int y, int c) const {
        return view_.at(std::clamp(x, 0, view_.width - 1), std::clamp(y, 0, view_.height - 1), c);
    }
    // How bright a pixel looks: of encoded values their weighted mean is near enough.
    float brightness(int x, int y) const {
        if (view_.channels == 1) return at(x, y, 0);
        return static_cast<float>(kLuminanceWeights[0]) * at(x, y, 0) +
               static_cast<float>(kLuminanceWeights[1]) * at(x, y, 1) +
               static_cast<float>(kLuminanceWeights[2]) * at(x, y, 2);
    }
    // Between pixel middles, which are whole numbers here.
    float between(float x, float y, int c) const {
        const float left = std::floor(x);
        const float top = std::floor(y);
        const float u = x - left;
        const float v = y - top;
        const int i = static_cast<int>(left);
        const int j = static_cast<int>(top);
        return (1 - v) * ((1 - u) * at(i, j, c) + u * at(i + 1, j, c)) +
               v * ((1 - u) * at(i, j + 1, c) + u * at(i + 1, j + 1, c));
    }

  private:
    ConstImageView view_;
};

// The unit tangent of the edge that a pixel lies on, and how much of the edge is to be smoothed.
struct Edge {
    float x = 0;
    float y = 0;
    float share = 0;
};

Edge edge_at(const Clamped& picture, int x, int y) {
    std::array<std::array<float, 3>, 3> n;
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i) {
            n[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)] =
                picture.brightness(x + i - 1, y + j - 1);
        }
    }
    // Scharr's derivative, whose direction is right to a degree: the step across an ideal edge.
    const float gx =
        (3 * (n[0][2] - n[0][0]) + 10 * (n[1][2] - n[1][0]) + 3 * (n[2][2] - n[2][0])) / 16;
    const float gy =
        (3 * (n[2][0] - n[0][0]) + 10 * (n[2][1] - n[0][1]) + 3 * (n[2][2] - n[0][2])) / 16;
    const float contrast = std::hypot(gx, gy);
    if (!(contrast > kLeastContrast)) return {};
    const float t = std::min((contrast - kLeastContrast) / (kFullContrast - kLeastContrast), 1.0F);
    return {-gy / contrast, gx / contrast, t * t * (3 - 2 * t)};
}

}  // namespace

void antialias_edges(const ConstImageView& display, const ImageView& out) {
    if (display.channels != 1 && display.channels != 3) {
        throw InvalidArgument("channels", std::to_string(display.channels), "must be 1 or 3");
    }
    if (out.width != display.width || out.height != display.height ||
        out.channels != display.channels) {
        throw InvalidArgument("result of antialiasing",
                              std::to_string(out.width) + "x" + std::to_string(out.height),
                              "must have the shape of the picture");
    }
    const Clamped picture(display);
    parallel_for(static_cast<std::size_t>(display.height), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < display.width; ++x) {
            const Edge edge = edge_at(picture, x, y);
            for (int c = 0; c < display.channels; ++c) {
                const float own = display.at(x, y, c);
                out.at(x, y, c) = own;
                if (edge.share == 0) continue;
                float mean = kWeights[0] * own;
                for (int i = 1; i <= kTaps; ++i) {
                    const float dx = static_cast<float>(i) * edge.x;
                    const float dy = static_cast<float>(i) * edge.y;
                    const auto px = static_cast<float>(x);
                    const auto py = static_cast<float>(y);
                    mean += kWeights[static_cast<std::size_t>(i)] *
                            (picture.between(px + dx, py + dy, c) +
                             picture.between(px - dx, py - dy, c));
                }
                out.at(x, y, c) = own + edge.share * (mean - own);
            }
        }
    });
}

}  // namespace aureole::color
