#include "aureole/wave/spectral_psf.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/units.h"

namespace aureole::wave {
namespace {

// Where a pixel looks: a box in direction cosines.
struct Footprint {
    double alpha = 0;  // centre
    double beta = 0;
    double half_alpha = 0;  // half widths
    double half_beta = 0;
};

// The box around the mapped centre of the pixel at offset (dx, dy) pixels from the axis (dy down).
//
// The exact footprint is a parallelogram with sides (d alpha/dx, d beta/dx), (d alpha/dy,
// d beta/dy). The box keeps the aspect of its diagonal and is scaled to the exact area |J|, so
// that densities come out right; what is neglected is the shear d alpha/dy / (d alpha/dx), in the
// perspective case u v / (1 + v^2): it displaces the corners by at most half of that fraction of
// a pixel, .003 px at 6 deg on the diagonal and .04 px at 23 deg.
Footprint footprint(Projection projection, double focal_px, double dx, double dy) {
    const double u = dx / focal_px;
    const double v = -dy / focal_px;
    const double pixel = 1 / focal_px;
    double alpha_x = 1;
    double beta_y = 1;
    double jacobian = 1;
    Footprint f;
    if (projection == Projection::kPerspective) {
        // alpha = u q, beta = v q, q = cos(theta); |J| = q^4.
        const double q = 1 / std::sqrt(1 + u * u + v * v);
        f.alpha = u * q;
        f.beta = v * q;
        alpha_x = q * q * q * (1 + v * v);
        beta_y = q * q * q * (1 + u * u);
        jacobian = q * q * q * q;
    } else {
        // alpha = u sin(theta)/theta, beta = v sin(theta)/theta with theta = |(u, v)|;
        // |J| = cos(theta) sin(theta)/theta.
        const double t2 = u * u + v * v;
        const double theta = std::sqrt(t2);
        const double s = theta > 1e-4 ? std::sin(theta) / theta : 1 - t2 / 6;
        const double c = std::cos(theta);
        const double bend = theta > 1e-4 ? (c - s) / t2 : -1.0 / 3;
        f.alpha = u * s;
        f.beta = v * s;
        alpha_x = s + u * u * bend;
        beta_y = s + v * v * bend;
        jacobian = c * s;
    }
    const double box = alpha_x * beta_y;
    const double fit = box > 0 && jacobian > 0 ? std::sqrt(jacobian / box) : 0;
    f.half_alpha = 0.5 * pixel * alpha_x * fit;
    f.half_beta = 0.5 * pixel * beta_y * fit;
    return f;
}

// The pixels of a few rows that receive anything, and what they have received.
struct Pixels {
    std::vector<Footprint> footprints;
    std::vector<int> x;
    std::vector<int> y;
    std::vector<color::Rgb> sums;

    void clear() {
        footprints.clear();
        x.clear();
        y.clear();
        sums.clear();
    }
};

struct Job {
    const PatternIntegral& pattern;
    PixelRule rule;
    Projection projection;
    double focal_px;
    int centre_x;
    int centre_y;
    AngleRange range;
    double widest_cosine;  // half the widest band, in direction cosines
    bool half;             // only the pixels before the centre, and itself
};

double angle_deg(const Footprint& f, const Job& job, double dx, double dy) {
    if (job.projection == Projection::kConstantPitch) {
        return deg_from_rad(std::hypot(dx, dy) / job.focal_px);
    }
    return deg_from_rad(std::asin(std::min(1.0, std::hypot(f.alpha, f.beta))));
}

void collect_row(const Job& job, int y, int width, Pixels& pixels) {
    const int end = job.half && y == job.centre_y ? job.centre_x + 1 : width;
    for (int x = 0; x < end; ++x) {
        const double dx = x - job.centre_x;
        const double dy = y - job.centre_y;
        if (job.projection == Projection::kConstantPitch &&
            std::hypot(dx, dy) >= job.focal_px * kPi / 2) {
            continue;  // behind the aperture
        }
        const Footprint f = footprint(job.projection, job.focal_px, dx, dy);
        if (std::abs(f.alpha) - f.half_alpha >= job.widest_cosine ||
            std::abs(f.beta) - f.half_beta >= job.widest_cosine) {
            continue;
        }
        const double angle = angle_deg(f, job, dx, dy);
        if (angle < job.range.min_deg || angle >= job.range.max_deg) continue;
        pixels.footprints.push_back(f);
        pixels.x.push_back(x);
        pixels.y.push_back(y);
        pixels.sums.push_back({});
    }
}

// One band over all collected pixels: four bilinear look-ups each, arranged as the difference of
// two table rows at four neighbouring columns.
void add_band(const Job& job, const color::SpectralBand& band, double samples_per_cosine,
              Pixels& pixels) {
    const int n = job.pattern.samples();
    const double limit = n;
    const double centre = n / 2 + 0.5;
    const auto stride = static_cast<std::ptrdiff_t>(n) + 1;
    const double* table = job.pattern.table();
    const std::size_t count = pixels.footprints.size();
    for (std::size_t p = 0; p < count; ++p) {
        const Footprint& f = pixels.footprints[p];
        const double u = f.alpha * samples_per_cosine + centre;
        const double v = f.beta * samples_per_cosine + centre;
        const double half_u = f.half_alpha * samples_per_cosine;
        const double half_v = f.half_beta * samples_per_cosine;
        const double u0 = std::clamp(u - half_u, 0.0, limit);
        const double u1 = std::clamp(u + half_u, 0.0, limit);
        const double v0 = std::clamp(v - half_v, 0.0, limit);
        const double v1 = std::clamp(v + half_v, 0.0, limit);
        if (u0 >= u1 || v0 >= v1) continue;
        const int i0 = std::min(static_cast<int>(u0), n - 1);
        const int i1 = std::min(static_cast<int>(u1), n - 1);
        const int j0 = std::min(static_cast<int>(v0), n - 1);
        const int j1 = std::min(static_cast<int>(v1), n - 1);
        const double fu0 = u0 - i0;
        const double fu1 = u1 - i1;
        const double fv0 = v0 - j0;
        const double fv1 = v1 - j1;
        const double* low = table + j0 * stride;
        const double* high = table + j1 * stride;
        const auto column = [&](int i) {
            return (high[i] + fv1 * (high[i + stride] - high[i])) -
                   (low[i] + fv0 * (low[i + stride] - low[i]));
        };
        const double right = column(i1) + fu1 * (column(i1 + 1) - column(i1));
        const double left = column(i0) + fu0 * (column(i0 + 1) - column(i0));
        double value = right - left;
        if (job.rule == PixelRule::kMean) value /= 4 * half_u * half_v;
        color::Rgb& sum = pixels.sums[p];
        for (std::size_t c = 0; c < 3; ++c) sum[c] += value * band.rgb[c];
    }
}

}  // namespace

void add_spectral(const PatternIntegral& pattern, double extent_mm, PixelRule rule,
                  std::span<const color::SpectralBand> bands, const KernelGrid& grid,
                  AngleRange range, const ImageView& out, Symmetry symmetry) {
    if (out.width != grid.width || out.height != grid.height || out.channels != 3) {
        throw InvalidArgument("kernel picture",
                              std::to_string(out.width) + "x" + std::to_string(out.height) + "x" +
                                  std::to_string(out.channels),
                              "must have the size of the grid, " + std::to_string(grid.width) +
                                  "x" + std::to_string(grid.height) + ", and 3 channels");
    }
    if (!(extent_mm > 0)) {
        throw InvalidArgument("aperture extent (mm)", std::to_string(extent_mm),
                              "must be positive");
    }
    double longest_mm = 0;
    for (const color::SpectralBand& band : bands) {
        longest_mm = std::max(longest_mm, mm_from_nm(band.wavelength_nm));
    }
    const Job job{pattern,
                  rule,
                  grid.projection,
                  grid.view().focal_length_px(),
                  grid.width / 2,
                  grid.height / 2,
                  range,
                  (pattern.samples() / 2 + 0.5) * longest_mm / extent_mm,
                  symmetry == Symmetry::kHalfTurn};
    const int rows = job.half ? job.centre_y + 1 : grid.height;

    // A few rows at a time: their part of the table stays in cache while all bands pass over it.
    constexpr int kRows = 8;
    std::vector<Pixels> scratch(static_cast<std::size_t>(max_workers()));
    const auto blocks = static_cast<std::size_t>((rows + kRows - 1) / kRows);
    parallel_for(blocks, [&](std::size_t block, int worker) {
        Pixels& pixels = scratch[static_cast<std::size_t>(worker)];
        pixels.clear();
        const int first = static_cast<int>(block) * kRows;
        for (int y = first; y < std::min(first + kRows, rows); ++y) {
            collect_row(job, y, grid.width, pixels);
        }
        for (const color::SpectralBand& band : bands) {
            add_band(job, band, extent_mm / mm_from_nm(band.wavelength_nm), pixels);
        }
        for (std::size_t p = 0; p < pixels.x.size(); ++p) {
            const int x = pixels.x[p];
            const int y = pixels.y[p];
            const bool mirror = job.half && (x != job.centre_x || y != job.centre_y);
            for (int c = 0; c < 3; ++c) {
                const auto sum = static_cast<float>(pixels.sums[p][static_cast<std::size_t>(c)]);
                out.at(x, y, c) += sum;
                if (mirror) out.at(grid.width - 1 - x, grid.height - 1 - y, c) += sum;
            }
        }
    });
}

}  // namespace aureole::wave
