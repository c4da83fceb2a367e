#include "ibl/exact_sum.h"

#include <algorithm>
#include <cmath>

#include "aureole/base/parallel.h"
#include "ibl/gauss_legendre.h"

namespace aureole::ibl {
namespace {

// The weight has poles where q = 0: seen from a point of the sphere whose weight is about 1/q^2, at
// a distance of 2 sqrt(q) rad. What the rules below can do depends on this distance over half the
// side of the cell that they integrate over, z: Gauss-Legendre with n points per side is off by
// some 16 (2 z)^(-2 n) of the integral (Trefethen 2008, "Is Gauss Quadrature Better than
// Clenshaw-Curtis?", theorem 4.5), the polynomial of second order by 16 z^-4. As the map from a
// face to the sphere has poles too, a distance beyond 1 counts as 1.
constexpr double kWholeTexel = 63;  // z from which the polynomial is good enough
constexpr double kTwoPoints = 30;
constexpr double kThreePoints = 8;
constexpr double kFourPoints = 4;  // below: four cells instead
constexpr int kDeepest = 30;       // of the quad-tree: far below what kLeastExactAlpha asks for
// A cell that a horizon cuts and that is integrated by points is not larger than this, in s and t.
constexpr double kLargestCutCell = 1.0 / 64;

// With 2, 3 and 4 points.
const std::array<GaussRule, 3>& rules() {
    static const std::array kRules = {gauss_legendre(2), gauss_legendre(3), gauss_legendre(4)};
    return kRules;
}

// What may lie between an output and a point of a block or cell: their centres' angle, less or
// more the sum of their radii.
struct Reach {
    double cosine = 1;
    double sine = 0;

    explicit Reach(double radius)
        : cosine(std::cos(std::min(radius, kPi / 2))), sine(std::sin(std::min(radius, kPi / 2))) {}
    double highest_mu(double mu) const {
        return mu >= cosine ? 1 : mu * cosine + sine_of(mu) * sine;
    }
    double lowest_mu(double mu) const {
        return mu <= -cosine ? -1 : mu * cosine - sine_of(mu) * sine;
    }
    static double sine_of(double mu) { return std::sqrt(std::max(0.0, 1 - mu * mu)); }
};

// z^2 of a cell of `side` in s and t whose nearest point has `mu`.
double squared_ratio(const GgxLobe& lobe, double mu, double side) {
    const double q = lobe.a2 + lobe.b * (1 - mu);
    return 16 * std::min(q, 0.25) / (side * side);
}

template <class Record, int kSize>
struct Batch {
    Record records[kSize];
    int count = 0;
    bool full() const { return count == kSize; }
    Record& next() { return records[count++]; }
};

// One call of ExactSum::add.
class Gather {
  public:
    Gather(const TexelGeometry& geometry, const float* light, double alpha,
           const Direction* normals, int count, LobeSums& sums)
        : geometry_(geometry),
          light_(light),
          lobe_(alpha),
          normals_(normals),
          count_(count),
          sums_(sums),
          block_reach_(0),
          texel_reach_(0) {
        Direction mean;
        for (int i = 0; i < count; ++i) {
            mean = {mean.x + normals[i].x, mean.y + normals[i].y, mean.z + normals[i].z};
        }
        centre_ = normalized(mean);
        for (int i = 0; i < count; ++i) {
            radius_ = std::max(radius_, std::acos(std::min(1.0, dot(centre_, normals[i]))));
        }
        block_reach_ = Reach(radius_ + geometry.block_radius);
        texel_reach_ = cell_reach(2.0 / geometry.size);

        outputs_.count = (count + kOutputBlock - 1) / kOutputBlock * kOutputBlock;
        outputs_.a2 = static_cast<float>(lobe_.a2);
        outputs_.b = static_cast<float>(lobe_.b);
        for (int i = 0; i < outputs_.count; ++i) {
            const Direction& n = normal(i);
            outputs_.offset[0][i] = static_cast<float>(n.x - centre_.x);
            outputs_.offset[1][i] = static_cast<float>(n.y - centre_.y);
            outputs_.offset[2][i] = static_cast<float>(n.z - centre_.z);
        }
    }

    void face(int face) {
        frame_ = face_frame(face);
        local_centre_ = in_frame(frame_, centre_);
        for (int i = 0; i < outputs_.count; ++i) {
            const auto [s, t, a] = in_frame(frame_, normal(i));
            const double values[6] = {s * s, t * t, a * a, 2 * s * t, 2 * s * a, 2 * t * a};
            outputs_.normal[0][i] = static_cast<float>(s);
            outputs_.normal[1][i] = static_cast<float>(t);
            outputs_.normal[2][i] = static_cast<float>(a);
            for (int k = 0; k < 6; ++k) outputs_.square[k][i] = static_cast<float>(values[k]);
        }
        for (int block = 0; block < geometry_.blocks; ++block) {
            add_block(block, light_ + static_cast<std::ptrdiff_t>(face * geometry_.blocks + block) *
                                          kTileTexels * 3);
        }
        flush_points();
    }

  private:
    // Past the end, the last one again.
    const Direction& normal(int i) const { return normals_[std::min(i, count_ - 1)]; }
    Reach cell_reach(double side) const { return Reach(radius_ + side * 0.7072); }

    void add_block(int block, const float* light) {
        const double mu =
            dot(local_centre_, geometry_.block_centre[static_cast<std::size_t>(block)]);
        const double highest = block_reach_.highest_mu(mu);
        if (highest <= 0) return;
        const Tile tile = tile_at(block, geometry_.size);
        const int texels = tile.width * tile.height;
        const TexelMoments* moments = geometry_.moments.data() + block * kTileTexels;
        if (block_reach_.lowest_mu(mu) >= 0 && whole(highest)) {
            exact_kernels().whole(outputs_, moments, light, texels, sums_);
            return;
        }
        const TexelSpread* spreads = geometry_.spreads.data() + block * kTileTexels;
        Batch<TexelMoments, kTileTexels> uncut;
        Batch<TexelMoments, kTileTexels> cut;
        TexelSpread cut_spreads[kTileTexels];
        float uncut_light[kTileTexels][3];
        float cut_light[kTileTexels][3];
        for (int i = 0; i < texels; ++i) {
            const float* mean = moments[i].mean;
            const double texel_mu = dot(local_centre_, {mean[0], mean[1], mean[2]});
            const double highest_mu = texel_reach_.highest_mu(texel_mu);
            if (highest_mu <= 0) continue;
            const float* texel_light = light + 3 * i;
            if (!whole(highest_mu)) {
                add_near_texel(tile, block, i, texel_light);
            } else if (texel_reach_.lowest_mu(texel_mu) >= 0) {
                std::copy_n(texel_light, 3, uncut_light[uncut.count]);
                uncut.next() = moments[i];
            } else {
                std::copy_n(texel_light, 3, cut_light[cut.count]);
                cut_spreads[cut.count] = spreads[i];
                cut.next() = moments[i];
            }
        }
        if (uncut.count > 0) {
            exact_kernels().whole(outputs_, uncut.records, uncut_light[0], uncut.count, sums_);
        }
        if (cut.count > 0) {
            exact_kernels().cut(outputs_, cut.records, cut_spreads, cut_light[0], cut.count, sums_);
        }
    }

    bool whole(double highest_mu) const {
        return squared_ratio(lobe_, highest_mu, 2.0 / geometry_.size) > kWholeTexel * kWholeTexel;
    }

    void add_near_texel(const Tile& tile, int block, int index, const float* light) {
        const double per_sr =
            1 / geometry_.solid_angle_sr[static_cast<std::size_t>(block * kTileTexels + index)];
        for (int c = 0; c < 3; ++c) radiance_[c] = light[c] * per_sr;
        const double side = 2.0 / geometry_.size;
        add_cell((tile.x + index % tile.width + .5) * side - 1,
                 (tile.y + index / tile.width + .5) * side - 1, side, 0);
    }

    void add_cell(double s, double t, double side, int depth) {
        const double mu = dot(local_centre_, {s, t, 1}) / std::sqrt(s * s + t * t + 1);
        const Reach reach = cell_reach(side);
        const double highest = reach.highest_mu(mu);
        if (highest <= 0) return;
        const bool is_cut = reach.lowest_mu(mu) < 0;
        const double ratio2 = squared_ratio(lobe_, highest, side);
        const bool split = ratio2 < kFourPoints * kFourPoints || (is_cut && side > kLargestCutCell);
        if (split && depth < kDeepest) {
            for (const double v : {-side / 4, side / 4}) {
                for (const double u : {-side / 4, side / 4}) {
                    add_cell(s + u, t + v, side / 2, depth + 1);
                }
            }
        } else if (!is_cut && ratio2 > kTwoPoints * kTwoPoints) {
            add_points(rules_[0], s, t, side / 2);
        } else if (!is_cut && ratio2 > kThreePoints * kThreePoints) {
            add_points(rules_[1], s, t, side / 2);
        } else {
            add_points(rules_[2], s, t, side / 2);
        }
    }

    void add_points(const GaussRule& rule, double s, double t, double half) {
        for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
            for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
                const Direction face_point = {s + half * rule.nodes[i], t + half * rule.nodes[j],
                                              1};
                const double scale = 1 / std::sqrt(dot(face_point, face_point));
                const Direction d = from_frame(frame_, face_point);
                const double solid_angle_sr =
                    half * half * rule.weights[i] * rule.weights[j] * scale * scale * scale;
                LobePoint& point = points_.next();
                point.offset[0] = static_cast<float>(d.x * scale - centre_.x);
                point.offset[1] = static_cast<float>(d.y * scale - centre_.y);
                point.offset[2] = static_cast<float>(d.z * scale - centre_.z);
                for (int c = 0; c < 3; ++c) {
                    point.light[c] = static_cast<float>(radiance_[c] * solid_angle_sr);
                }
                if (points_.full()) flush_points();
            }
        }
    }

    void flush_points() {
        exact_kernels().points(outputs_, points_.records, points_.count, sums_);
        points_.count = 0;
    }

    const TexelGeometry& geometry_;
    const std::array<GaussRule, 3>& rules_ = rules();
    const float* light_;
    GgxLobe lobe_;
    const Direction* normals_;
    int count_;
    LobeSums& sums_;
    Direction centre_;  // of the outputs
    double radius_ = 0;
    Reach block_reach_;
    Reach texel_reach_;
    // Of the face at hand.
    FaceFrame frame_;
    Direction local_centre_;
    double radiance_[3] = {};  // of the texel at hand
    LobeOutputs outputs_;
    Batch<LobePoint, 256> points_;
};

}  // namespace

ExactSum::ExactSum(int size)
    : geometry_(size), light_(static_cast<std::size_t>(tile_count(size)) * kTileTexels * 3) {}

void ExactSum::prepare(const CubeMap& environment) noexcept {
    parallel_for(static_cast<std::size_t>(kFaces * geometry_.blocks), [&](std::size_t block, int) {
        const Tile tile = tile_at(static_cast<int>(block), geometry_.size);
        const std::size_t in_face = block % static_cast<std::size_t>(geometry_.blocks);
        for (int i = 0; i < tile.width * tile.height; ++i) {
            const double solid_angle_sr =
                geometry_.solid_angle_sr[in_face * kTileTexels + static_cast<std::size_t>(i)];
            for (int c = 0; c < 3; ++c) {
                const float radiance =
                    environment.at(tile.face, tile.x + i % tile.width, tile.y + i / tile.width, c);
                light_[(block * kTileTexels + static_cast<std::size_t>(i)) * 3 +
                       static_cast<std::size_t>(c)] = static_cast<float>(radiance * solid_angle_sr);
            }
        }
    });
}

void ExactSum::add(double alpha, const Direction* normals, int count,
                   LobeSums& sums) const noexcept {
    Gather gather(geometry_, light_.data(), alpha, normals, count, sums);
    for (int face = 0; face < kFaces; ++face) gather.face(face);
}

}  // namespace aureole::ibl
