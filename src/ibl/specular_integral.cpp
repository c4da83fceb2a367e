// f(L, V) = D(H) G(L, V) F(V.H) / (4 (N.L) (N.V)) with D of GGX (Walter et al. 2007, eq. 33) and
// its height-correlated Smith term (Heitz 2014, "Understanding the Masking-Shadowing Function in
// Microfacet-Based BRDFs", eq. 99). Half of the samples follow the visible normals (Heitz 2018,
// "Sampling the GGX Distribution of Visible Normals"), half the light of the texels; the balance
// heuristic joins them (Veach & Guibas 1995, "Optimally Combining Sampling Techniques for Monte
// Carlo Rendering", eq. 14).
#include "ibl/specular_integral.h"

#include <algorithm>
#include <cmath>

#include "aureole/base/units.h"

namespace aureole::ibl {
namespace {

// Below this a lobe is narrower than any texel.
constexpr double kMirrorAlpha = 1e-4;
constexpr std::size_t kLightSamples = 65536;

Direction reflected(const Direction& view, const Direction& about) {
    const double twice = 2 * dot(view, about);
    return {twice * about.x - view.x, twice * about.y - view.y, twice * about.z - view.z};
}

// Axes of a surface: z along the normal, the view in the plane of x and z.
struct Frame {
    Direction x, y, z;

    Frame(const Direction& normal, const Direction& view) : z(normal) {
        const double nv = dot(normal, view);
        Direction along = {view.x - nv * normal.x, view.y - nv * normal.y, view.z - nv * normal.z};
        if (dot(along, along) < 1e-16) {
            along = std::abs(normal.z) < 0.5 ? Direction{-normal.y, normal.x, 0}
                                             : Direction{normal.z, 0, -normal.x};
        }
        x = normalized(along);
        y = {z.y * x.z - z.z * x.y, z.z * x.x - z.x * x.z, z.x * x.y - z.y * x.x};
    }
    Direction world(const Direction& d) const {
        return {d.x * x.x + d.y * y.x + d.z * z.x, d.x * x.y + d.y * y.y + d.z * z.y,
                d.x * x.z + d.y * y.z + d.z * z.z};
    }
};

// Heitz 2018, listing 1, for a view of azimuth 0.
Direction visible_normal(double alpha, double sin_v, double cos_v, double u, double v) {
    const Direction stretched = normalized({alpha * sin_v, 0, cos_v});
    const double radius = std::sqrt(u);
    const double p = radius * std::cos(2 * kPi * v);
    const double share = 0.5 * (1 + stretched.z);
    const double q = (1 - share) * std::sqrt(1 - p * p) + share * radius * std::sin(2 * kPi * v);
    const double up = std::sqrt(std::max(0.0, 1 - p * p - q * q));
    const Direction hemisphere = {up * stretched.x - q * stretched.z, p,
                                  up * stretched.z + q * stretched.x};
    return normalized({alpha * hemisphere.x, alpha * hemisphere.y, std::max(0.0, hemisphere.z)});
}

// The additive sequence of the plastic number (Roberts 2018, "The Unreasonable Effectiveness of
// Quasirandom Sequences").
struct Sequence {
    double u0 = 0;
    double v0 = 0;
    double u(std::size_t i) const {
        return fraction(u0 + static_cast<double>(i) * 0.7548776662466927);
    }
    double v(std::size_t i) const {
        return fraction(v0 + static_cast<double>(i) * 0.5698402909980532);
    }
    static double fraction(double value) { return value - std::floor(value); }
};

// lowbias32 (Wellons 2018, "Prospecting for Hash Functions").
std::uint32_t hash(std::uint32_t value) {
    value = (value ^ value >> 16U) * 0x7feb352dU;
    value = (value ^ value >> 15U) * 0x846ca68bU;
    return value ^ value >> 16U;
}

// Density by solid angle for one by area on the plane of a face.
double solid_angle_density(const CubePoint& point) {
    const double h = 1 + point.s * point.s + point.t * point.t;
    return h * std::sqrt(h);
}

}  // namespace

SpecularIntegral::SpecularIntegral(const CubeMap& environment)
    : sampler_(CubeChain{environment}), size_(environment.size()) {
    std::vector<double> light;
    double sum = 0;
    for (int face = 0; face < kFaces; ++face) {
        for (int y = 0; y < size_; ++y) {
            for (int x = 0; x < size_; ++x) {
                Texel texel;
                double brightness = 0;
                for (int c = 0; c < 3; ++c) {
                    const float value = environment.at(face, x, y, c);
                    texel.rgb[static_cast<std::size_t>(c)] = value;
                    brightness += std::max(0.0F, value);
                }
                texels_.push_back(texel);
                light.push_back(brightness * texel_solid_angle_sr(x, y, size_));
                sum += light.back();
            }
        }
    }
    // A thousandth is shared equally: every texel has a chance, and black maps are no exception.
    const auto count = static_cast<double>(texels_.size());
    std::vector<double> cumulative = {0};  // probability of all texels before each
    for (std::size_t i = 0; i < texels_.size(); ++i) {
        const double share = sum > 0 ? 0.999 * light[i] / sum + 0.001 / count : 1 / count;
        texels_[i].density = static_cast<float>(share * size_ * size_ / 4);
        cumulative.push_back(cumulative.back() + share);
    }
    const Sequence places;
    for (std::size_t i = 0; i < kLightSamples; ++i) {
        lights_.push_back(sample_light(cumulative, places.u(i), places.v(i)));
    }
}

const SpecularIntegral::Texel& SpecularIntegral::texel_at(const CubePoint& point) const noexcept {
    const auto index = [&](double place) {
        return std::clamp(static_cast<int>((place + 1) / 2 * size_), 0, size_ - 1);
    };
    return texels_[static_cast<std::size_t>((point.face * size_ + index(point.t)) * size_ +
                                            index(point.s))];
}

SpecularIntegral::LightSample SpecularIntegral::sample_light(const std::vector<double>& cumulative,
                                                             double u, double v) const {
    const double wanted = u * cumulative.back();
    const auto above = std::upper_bound(cumulative.begin() + 1, cumulative.end() - 1, wanted);
    const auto below = above - 1;
    // What is left of u within the texel is evenly spread again.
    const double within = std::clamp((wanted - *below) / (*above - *below), 0.0, 1.0);
    const auto index = static_cast<int>(below - cumulative.begin());
    const int column = index % size_;
    const int row = index / size_;
    const CubePoint point = {row / size_, 2 * (column + within) / size_ - 1,
                             2 * (row % size_ + v) / size_ - 1};
    const Texel& texel = texels_[static_cast<std::size_t>(index)];
    return {direction_of(point), texel.rgb,
            static_cast<float>(texel.density * solid_angle_density(point))};
}

SpecularRadiance SpecularIntegral::estimate(const Direction& normal, const Direction& view,
                                            double alpha, int first, int count,
                                            std::uint32_t seed) const noexcept {
    SpecularRadiance result;
    const double nv = std::max(1e-6, dot(normal, view));
    const auto add = [&](const std::array<float, 3>& rgb, double weight, double vh) {
        const double away = std::max(0.0, 1 - vh);
        const double fresnel = away * away * away * away * away;
        for (std::size_t c = 0; c < 3; ++c) {
            result.scale[c] += weight * (1 - fresnel) * rgb[c];
            result.bias[c] += weight * fresnel * rgb[c];
        }
    };
    if (alpha < kMirrorAlpha) {
        add(sampler_.sample(reflected(view, normal), 0), 1, nv);
        return result;
    }
    const double a2 = alpha * alpha;
    const double view_root = std::sqrt(a2 + (1 - a2) * nv * nv);
    const auto add_sample = [&](const Direction& light, const std::array<float, 3>& rgb,
                                double light_density) {
        const double nl = dot(normal, light);
        if (nl <= 0) return;
        const Direction half = normalized({light.x + view.x, light.y + view.y, light.z + view.z});
        const double nh = dot(normal, half);
        const double bowl = 1 - (1 - a2) * nh * nh;
        const double d = a2 / (kPi * bowl * bowl);
        const double visibility = 0.5 / (nl * view_root + nv * std::sqrt(a2 + (1 - a2) * nl * nl));
        const double brdf_density = d / (2 * (nv + view_root));
        add(rgb, 2 * d * visibility * nl / (count * (light_density + brdf_density)),
            dot(view, half));
    };
    const Frame frame(normal, view);
    const double sin_v = std::sqrt(std::max(0.0, 1 - nv * nv));
    const std::uint32_t random = hash(seed);
    const Sequence turned = {random * 0x1p-32, hash(random ^ 0x9e3779b9U) * 0x1p-32};
    for (auto i = static_cast<std::size_t>(first) / 2;
         i < static_cast<std::size_t>(first + count) / 2; ++i) {
        const Direction half =
            frame.world(visible_normal(alpha, sin_v, nv, turned.u(i), turned.v(i)));
        const Direction light = reflected(view, half);
        const CubePoint point = cube_point_of(light);
        const Texel& texel = texel_at(point);
        add_sample(light, texel.rgb, texel.density * solid_angle_density(point));
        const LightSample& bright = lights_[(random + i) % kLightSamples];
        add_sample(bright.direction, bright.rgb, bright.density);
    }
    return result;
}

}  // namespace aureole::ibl
