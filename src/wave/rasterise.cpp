// Exact area coverage of polygons by signed-area accumulation: every edge adds to each cell it
// crosses the signed area between itself and the cell's right side, and its height to the cell
// after it; the running sum along the row is then the covered area of each cell (Heckbert's and
// Levien's method for font outlines; the "exact area" mode of stb_truetype 2).
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "aureole/wave/mask_shapes.h"

namespace aureole::wave {
namespace {

// Cells [first, end) of the mask.
struct Box {
    int first_column = 0;
    int end_column = 0;
    int first_row = 0;
    int end_row = 0;

    int columns() const { return end_column - first_column; }
    bool empty() const { return end_column <= first_column || end_row <= first_row; }
};

// Continuous raster coordinates: cell (i, j) covers [i, i + 1) x [j, j + 1), so that its centre
// is at ApertureGrid::x_mm(i), y_mm(j).
struct Vertex {
    double x;
    double y;
};

class Transform {
  public:
    explicit Transform(const ApertureGrid& grid)
        : scale_(1 / grid.spacing_mm()), shift_(grid.samples / 2 + 0.5) {}
    Vertex operator()(double x_mm, double y_mm) const {
        return {x_mm * scale_ + shift_, y_mm * scale_ + shift_};
    }

  private:
    double scale_;
    double shift_;
};

Box box_around(const Vertex& low, const Vertex& high, int samples) {
    const auto floor_cell = [&](double x) {
        return static_cast<int>(std::floor(std::clamp(x, 0.0, static_cast<double>(samples))));
    };
    const auto ceil_cell = [&](double x) {
        return static_cast<int>(std::ceil(std::clamp(x, 0.0, static_cast<double>(samples))));
    };
    return {floor_cell(low.x), ceil_cell(high.x), floor_cell(low.y), ceil_cell(high.y)};
}

// Accumulates edges over a box of cells and hands out the coverage row by row. Cells are grouped
// in blocks; blocks without an edge are runs of constant coverage.
class Accumulator {
  public:
    void begin(const Box& box) {
        box_ = box;
        // An edge may add to the cell after the one it ends in, twice.
        stride_ = static_cast<std::size_t>(box.columns()) + 2;
        blocks_ = (static_cast<std::size_t>(box.columns()) >> kBlockShift) + 1;
        const auto rows = static_cast<std::size_t>(box.end_row - box.first_row);
        cells_.assign(stride_ * rows, 0.0);
        touched_.assign(blocks_ * rows, 0);
    }

    void add_edge(Vertex a, Vertex b) {
        a.x -= box_.first_column;
        b.x -= box_.first_column;
        a.y -= box_.first_row;
        b.y -= box_.first_row;
        // Going up on the right covers what lies to the left: coverage is minus the running sum.
        double sign = -1;
        if (a.y > b.y) {
            std::swap(a, b);
            sign = 1;
        }
        const double height = box_.end_row - box_.first_row;
        if (b.y <= 0 || a.y >= height || a.y == b.y) return;
        const double slope = (b.x - a.x) / (b.y - a.y);
        if (a.y < 0) a = {a.x - a.y * slope, 0};
        if (b.y > height) b = {b.x + (height - b.y) * slope, height};
        clip_columns(a, b, slope, sign);
    }

    // Calls span(first_column, count, coverage) with constant runs and cell(column, coverage).
    template <class Span, class Cell>
    void sweep_row(int row, const Span& span, const Cell& cell) const {
        const auto r = static_cast<std::size_t>(row - box_.first_row);
        const double* cells = cells_.data() + r * stride_;
        const std::uint8_t* touched = touched_.data() + r * blocks_;
        double sum = 0;
        const int columns = box_.columns();
        for (int start = 0; start < columns; start += 1 << kBlockShift) {
            const int end = std::min(start + (1 << kBlockShift), columns);
            if (touched[start >> kBlockShift] == 0) {
                span(box_.first_column + start, end - start, coverage(sum));
                continue;
            }
            for (int i = start; i < end; ++i) {
                sum += cells[i];
                cell(box_.first_column + i, coverage(sum));
            }
        }
    }

  private:
    static constexpr int kBlockShift = 4;

    // Rounding of the running sum must not leave light outside a shape.
    static float coverage(double sum) {
        return sum < 1e-12 ? 0.0F : static_cast<float>(std::min(sum, 1.0));
    }

    // What lies left of the box covers its whole width; what lies right of it covers nothing.
    void clip_columns(Vertex a, Vertex b, double slope, double sign) {
        const double width = box_.columns();
        for (const double border : {0.0, width}) {
            if ((a.x < border && b.x > border) || (a.x > border && b.x < border)) {
                const double y = std::clamp(a.y + (border - a.x) / slope, a.y, b.y);
                clip_columns(a, {border, y}, slope, sign);
                clip_columns({border, y}, b, slope, sign);
                return;
            }
        }
        if (a.x >= width && b.x >= width) return;
        a.x = std::clamp(a.x, 0.0, width);
        b.x = std::clamp(b.x, 0.0, width);
        if (b.y > a.y) add_rows(a, b, sign);
    }

    void add_rows(const Vertex& a, const Vertex& b, double sign) {
        const double slope = (b.x - a.x) / (b.y - a.y);
        const double low = std::min(a.x, b.x);
        const double high = std::max(a.x, b.x);
        const int last_row = box_.end_row - box_.first_row - 1;
        double x = a.x;
        double y = a.y;
        for (int row = std::min(static_cast<int>(y), last_row); y < b.y && row <= last_row; ++row) {
            const double next_y = std::min(row + 1.0, b.y);
            const double next_x = std::clamp(a.x + (next_y - a.y) * slope, low, high);
            add_cells(row, std::min(x, next_x), std::max(x, next_x), sign * (next_y - y));
            x = next_x;
            y = next_y;
        }
    }

    // A piece of an edge within one row, from x0 <= x1, of signed height h.
    void add_cells(int row, double x0, double x1, double h) {
        double* cells = cells_.data() + static_cast<std::size_t>(row) * stride_;
        std::uint8_t* touched = touched_.data() + static_cast<std::size_t>(row) * blocks_;
        const int first = static_cast<int>(x0);
        const int last = std::max(first, static_cast<int>(std::ceil(x1)) - 1);
        for (int block = first >> kBlockShift; block <= (last + 1) >> kBlockShift; ++block) {
            if (static_cast<std::size_t>(block) < blocks_) touched[block] = 1;
        }
        if (first == last) {
            const double inside = (x0 + x1) / 2 - first;
            cells[first] += h * (1 - inside);
            cells[first + 1] += h * inside;
            return;
        }
        // Running area to the right of the edge within each cell; its increments are stored.
        const double per_cell = h / (x1 - x0);
        const double lead = first + 1 - x0;
        double before = 0.5 * per_cell * lead * lead;
        cells[first] += before;
        double entered = per_cell * lead;  // height reached at the left side of the next cell
        for (int i = first + 1; i < last; ++i) {
            const double area = entered + 0.5 * per_cell;
            cells[i] += area - before;
            before = area;
            entered += per_cell;
        }
        const double rest = x1 - last;
        const double area = h - 0.5 * per_cell * rest * rest;
        cells[last] += area - before;
        cells[last + 1] += h - area;
    }

    Box box_;
    std::size_t stride_ = 0;
    std::size_t blocks_ = 0;
    std::vector<double> cells_;
    std::vector<std::uint8_t> touched_;
};

float blended(Blend blend, float m, float value, float coverage) {
    switch (blend) {
        case Blend::kAdd:
            return m + value * coverage;
        case Blend::kMax:
            return std::max(m, value * coverage);
        case Blend::kMultiply:
            return m * (1 + (value - 1) * coverage);
        case Blend::kKeep:
            return m * (value * coverage);
    }
    return m;
}

void blend_rows(Mask& mask, const Accumulator& coverage, const Box& box, Blend blend, float value) {
    for (int j = box.first_row; j < box.end_row; ++j) {
        float* row = mask.row(j);
        coverage.sweep_row(
            j,
            [&](int first, int count, float c) {
                if (c == 0 && blend != Blend::kKeep) return;
                for (int i = first; i < first + count; ++i) {
                    row[i] = blended(blend, row[i], value, c);
                }
            },
            [&](int i, float c) { row[i] = blended(blend, row[i], value, c); });
    }
}

constexpr int kBandRows = 32;

}  // namespace

void draw(Mask& mask, const Shape& shape, Blend blend, float value) {
    const int samples = mask.grid.samples;
    const Transform to_raster(mask.grid);
    std::vector<std::vector<Vertex>> outlines;
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    Vertex low{kInfinity, kInfinity};
    Vertex high{-kInfinity, -kInfinity};
    for (const auto& points : shape.outlines) {
        auto& outline = outlines.emplace_back();
        outline.reserve(points.size());
        for (const Point& p : points) {
            if (!std::isfinite(p.x_mm) || !std::isfinite(p.y_mm)) {
                throw InvalidArgument("outline point (mm)",
                                      std::to_string(p.x_mm) + ", " + std::to_string(p.y_mm),
                                      "must be finite");
            }
            const Vertex v = outline.emplace_back(to_raster(p.x_mm, p.y_mm));
            low = {std::min(low.x, v.x), std::min(low.y, v.y)};
            high = {std::max(high.x, v.x), std::max(high.y, v.y)};
        }
    }
    const Box box = box_around(low, high, samples);
    if (blend == Blend::kKeep) {  // nothing outside the box stays
        parallel_for(static_cast<std::size_t>(samples), [&](std::size_t index, int) {
            const int j = static_cast<int>(index);
            float* row = mask.row(j);
            const bool inside = !box.empty() && j >= box.first_row && j < box.end_row;
            std::fill(row, row + (inside ? box.first_column : samples), 0.0F);
            if (inside) std::fill(row + box.end_column, row + samples, 0.0F);
        });
    }
    if (box.empty()) return;

    std::vector<Accumulator> accumulators(static_cast<std::size_t>(max_workers()));
    const int bands = (box.end_row - box.first_row + kBandRows - 1) / kBandRows;
    parallel_for(static_cast<std::size_t>(bands), [&](std::size_t index, int worker) {
        Box band = box;
        band.first_row = box.first_row + static_cast<int>(index) * kBandRows;
        band.end_row = std::min(band.first_row + kBandRows, box.end_row);
        Accumulator& coverage = accumulators[static_cast<std::size_t>(worker)];
        coverage.begin(band);
        for (const auto& outline : outlines) {
            for (std::size_t k = 0; k < outline.size(); ++k) {
                coverage.add_edge(outline[k], outline[k + 1 == outline.size() ? 0 : k + 1]);
            }
        }
        blend_rows(mask, coverage, band, blend, value);
    });
}

void draw_particles(Mask& mask, std::span<const Particle> particles, Blend blend, float value) {
    if (blend == Blend::kKeep) {
        throw InvalidArgument("Blend::kKeep cannot draw particles: use kAdd, kMax or kMultiply");
    }
    const int samples = mask.grid.samples;
    const Transform to_raster(mask.grid);
    const double scale = 1 / mask.grid.spacing_mm();

    // Which particles touch which band of rows, in the order given.
    const int bands = (samples + kBandRows - 1) / kBandRows;
    std::vector<std::vector<std::uint32_t>> members(static_cast<std::size_t>(bands));
    for (std::size_t p = 0; p < particles.size(); ++p) {
        const Particle& particle = particles[p];
        if (!(particle.radius_mm > 0) || !std::isfinite(particle.radius_mm) ||
            !std::isfinite(particle.x_mm) || !std::isfinite(particle.y_mm)) {
            throw InvalidArgument("particle " + std::to_string(p) + " radius (mm)",
                                  std::to_string(particle.radius_mm),
                                  "must be positive, and its position finite");
        }
        const double y = to_raster(particle.x_mm, particle.y_mm).y;
        const double reach = particle.radius_mm * scale * 1.1;
        if (y + reach < 0 || y - reach >= samples) continue;
        const int first = static_cast<int>(std::max(y - reach, 0.0)) / kBandRows;
        const int last = static_cast<int>(std::min(y + reach, samples - 1.0)) / kBandRows;
        for (int band = first; band <= last; ++band) {
            members[static_cast<std::size_t>(band)].push_back(static_cast<std::uint32_t>(p));
        }
    }

    std::vector<Accumulator> accumulators(static_cast<std::size_t>(max_workers()));
    parallel_for(members.size(), [&](std::size_t band, int worker) {
        Accumulator& coverage = accumulators[static_cast<std::size_t>(worker)];
        const int band_first = static_cast<int>(band) * kBandRows;
        const int band_end = std::min(band_first + kBandRows, samples);
        for (const std::uint32_t p : members[band]) {
            const Shape shape =
                disc(particles[p].radius_mm, {particles[p].x_mm, particles[p].y_mm});
            const Vertex centre = to_raster(particles[p].x_mm, particles[p].y_mm);
            const double reach = particles[p].radius_mm * scale * 1.1;
            Box box = box_around({centre.x - reach, centre.y - reach},
                                 {centre.x + reach, centre.y + reach}, samples);
            box.first_row = std::max(box.first_row, band_first);
            box.end_row = std::min(box.end_row, band_end);
            if (box.empty()) continue;
            coverage.begin(box);
            const auto& points = shape.outlines.front();
            Vertex previous = to_raster(points.back().x_mm, points.back().y_mm);
            for (const Point& point : points) {
                const Vertex next = to_raster(point.x_mm, point.y_mm);
                coverage.add_edge(previous, next);
                previous = next;
            }
            blend_rows(mask, coverage, box, blend, value);
        }
    });
}

}  // namespace aureole::wave
