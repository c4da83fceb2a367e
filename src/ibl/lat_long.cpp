#include "aureole/ibl/lat_long.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "aureole/image/finite.h"
#include "ibl/adjust.h"
#include "ibl/lat_long_grid.h"
#include "ibl/outlines.h"
#include "ibl/rotation.h"
#include "ibl/running_sums.h"

namespace aureole::ibl {
namespace {

constexpr int kMostPixels = 65536;
// Rows that are integrated at once: as many as fit into 8 MiB, and not so few that blocks are cut
// all over.
constexpr int kBandBytes = 8 << 20;
constexpr int kFewestBandRows = 33;
constexpr int kBlockSide = 16;

void check_side(const char* name, int value) {
    if (value < 1 || value > kMostPixels) {
        throw InvalidArgument(name, std::to_string(value),
                              "a latitude-longitude picture has 1 to 65536 pixels per side");
    }
}

// Blocks of texels, the unit of work.
std::vector<Tile> blocks_of(int size) {
    std::vector<Tile> blocks;
    for (int face = 0; face < kFaces; ++face) {
        for (int y = 0; y < size; y += kBlockSide) {
            for (int x = 0; x < size; x += kBlockSide) {
                blocks.push_back(
                    {face, x, y, std::min(kBlockSide, size - x), std::min(kBlockSide, size - y)});
            }
        }
    }
    return blocks;
}

struct Block {
    Tile tile;
    int first_strip;
    int end_strip;
};

int band_rows_of(const LatLongGrid& grid) {
    const int affordable = kBandBytes / (3 * static_cast<int>(sizeof(float)) * grid.width);
    return std::min(grid.strips + 1, std::max(kFewestBandRows, affordable));
}

// The faces that see the same outlines as the block of another face, moved along the rows: when the
// cube stands upright in the picture, its four sides do.
constexpr int kFrontFace = 4;
constexpr std::array<int, 4> kSides = {0, 1, 4, 5};
bool is_side(int face) { return face != 2 && face != 3; }

struct Worker {
    Worker(const LatLongGrid& grid, const Rotation& rotation)
        : outlines(grid, rotation), sums(grid) {}
    Outlines outlines;
    RunningSums sums;
    std::array<CellSum, kBlockSide * kBlockSide> cells;
};

}  // namespace

Direction direction_of(const LatLongPoint& point, int width, int height) {
    const double longitude = kPi - 2 * kPi * point.u / width;
    const double latitude = kPi / 2 - kPi * point.v / height;
    return {std::sin(longitude) * std::cos(latitude), std::sin(latitude),
            std::cos(longitude) * std::cos(latitude)};
}

LatLongPoint lat_long_point_of(const Direction& direction, int width, int height) {
    const Direction d = normalized(direction);
    const double latitude = std::atan2(d.y, std::hypot(d.x, d.z));
    return {width * (0.5 - std::atan2(d.x, d.z) / (2 * kPi)), height * (0.5 - latitude / kPi)};
}

double lat_long_solid_angle_sr(int y, int width, int height) {
    // cos(a) - cos(b) as a product, which does not cancel.
    const double step = kPi / height;
    return 2 * kPi / width * 2 * std::sin((y + 0.5) * step) * std::sin(0.5 * step);
}

struct LatLongToCube::Impl {
    Impl(int width, int height, int size, const EnvironmentTransform& transform)
        : grid(width, height),
          rotation(transform),
          adjustment(transform),
          cube(size),
          areas(size, kFaces * size, 1),
          band(width, band_rows_of(grid), 3),
          upright(std::abs(rotation.undo({0, 1, 0}).y) == 1) {
        for (const Tile& tile : blocks_of(size)) {
            if (upright && is_side(tile.face) && tile.face != kFrontFace) continue;
            const BlockBounds bounds = bounds_of(tile, size, grid, rotation);
            blocks.push_back({tile, bounds.first_strip, bounds.end_strip});
        }
        for (int i = 0; i < max_workers(); ++i) workers.emplace_back(grid, rotation);
    }

    void take(const ConstImageView& rows, int first, int count);
    void integrate_band(int end_strip);
    void add_block(Worker& worker, const Tile& tile, double shift);

    LatLongGrid grid;
    Rotation rotation;
    Adjustment adjustment;
    CubeMap cube;
    Image areas;  // of the texels, in the unit of the sums; as cube.stacked()
    Image band;   // rows from that of node first_strip on
    int band_rows = 0;
    bool upright;
    int first_strip = 0;
    int next_row = 0;
    bool finished = false;
    std::vector<Block> blocks;
    std::vector<Worker> workers;
    std::vector<const Block*> touched;
    std::vector<Tally> tallies;
    Tally tally;
    EnvironmentReport report;
};

// Copies rows [first, first + count) into the band, cleaned.
void LatLongToCube::Impl::take(const ConstImageView& rows, int first, int count) {
    ImageView target = band.view();
    target.data = band.row(band_rows, 0);
    target.height = count;
    parallel_for(static_cast<std::size_t>(count), [&](std::size_t i, int) {
        const int y = static_cast<int>(i);
        for (int c = 0; c < 3; ++c) {
            const float* from = rows.data + rows.offset(0, first + y, c);
            float* to = &target.at(0, y, c);
            for (int x = 0; x < rows.width; ++x) to[x] = from[x * rows.pixel_stride];
        }
    });
    report.nonfinite_texels += replace_nonfinite(target);
    if (adjustment.needed()) {
        tallies.assign(static_cast<std::size_t>(count), {});
        parallel_for(static_cast<std::size_t>(count), [&](std::size_t i, int) {
            const int y = static_cast<int>(i);
            const double solid_angle =
                lat_long_solid_angle_sr(next_row + y, grid.width, grid.height);
            tallies[i] = adjustment.row(target, y, [=](int) { return solid_angle; });
        });
        for (const Tally& row : tallies) tally.add(row);
        tally.write(report);
    }
    // The nodes of the first and the last row are the poles, where all columns meet: the function
    // is continuous when they have one value, and their energy is the same.
    for (const int row : {0, grid.height - 1}) {
        if (row < next_row || row >= next_row + count || grid.height == 1) continue;
        for (int c = 0; c < 3; ++c) {
            float* values = &target.at(0, row - next_row, c);
            const double sum = std::accumulate(values, values + grid.width, 0.0);
            std::fill_n(values, grid.width, static_cast<float>(sum / grid.width));
        }
    }
    band_rows += count;
    next_row += count;
}

// Strips [first_strip, end_strip), whose rows are all in the band.
void LatLongToCube::Impl::integrate_band(int end_strip) {
    touched.clear();
    for (const Block& block : blocks) {
        if (block.first_strip < end_strip && block.end_strip > first_strip) {
            touched.push_back(&block);
        }
    }
    const auto middle = [&](int face) {
        const Direction d = rotation.undo(ibl::direction_of({face, 0, 0}));
        return grid.column(d.x, d.z);
    };
    parallel_for(touched.size(), [&](std::size_t i, int index) {
        Worker& worker = workers[static_cast<std::size_t>(index)];
        Tile tile = touched[i]->tile;
        worker.outlines.trace(tile, cube.size(), first_strip, end_strip);
        add_block(worker, tile, 0);
        if (!upright || tile.face != kFrontFace) return;
        for (const int face : kSides) {
            if (face == kFrontFace) continue;
            tile.face = face;
            add_block(worker, tile, middle(face) - middle(kFrontFace));
        }
    });
}

// Adds what the traced outlines hold, moved by `shift` columns, to the texels of a block.
void LatLongToCube::Impl::add_block(Worker& worker, const Tile& tile, double shift) {
    worker.cells.fill({});
    worker.sums.integrate(worker.outlines, shift, band, first_strip, worker.cells.data());
    for (int y = 0; y < tile.height; ++y) {
        const CellSum* cells = &worker.cells[static_cast<std::size_t>(y * tile.width)];
        float* area = areas.row(tile.face * cube.size() + tile.y + y, 0) + tile.x;
        for (int x = 0; x < tile.width; ++x) area[x] += static_cast<float>(cells[x].area);
        for (int c = 0; c < 3; ++c) {
            float* sums = cube.row(tile.face, tile.y + y, c) + tile.x;
            for (int x = 0; x < tile.width; ++x) sums[x] += static_cast<float>(cells[x].rgb[c]);
        }
    }
}

LatLongToCube::LatLongToCube(int width, int height, int cube_size,
                             const EnvironmentTransform& transform) {
    check_side("width", width);
    check_side("height", height);
    impl_ = std::make_unique<Impl>(width, height, cube_size, transform);
}

LatLongToCube::~LatLongToCube() = default;
LatLongToCube::LatLongToCube(LatLongToCube&&) noexcept = default;
LatLongToCube& LatLongToCube::operator=(LatLongToCube&&) noexcept = default;

const EnvironmentReport& LatLongToCube::report() const noexcept { return impl_->report; }

void LatLongToCube::add_rows(int first_row, const ConstImageView& rows) {
    Impl& impl = *impl_;
    const LatLongGrid& grid = impl.grid;
    if (rows.width != grid.width || rows.channels != 3) {
        throw InvalidArgument(
            "rows",
            std::to_string(rows.width) + " pixels, " + std::to_string(rows.channels) + " channels",
            "must have " + std::to_string(grid.width) + " and 3");
    }
    if (first_row != impl.next_row || rows.height < 0 || rows.height > grid.height - first_row) {
        throw InvalidArgument(
            "first_row", std::to_string(first_row),
            "rows are added from the top, each once: " + std::to_string(impl.next_row) +
                " comes next of " + std::to_string(grid.height));
    }
    for (int done = 0; done < rows.height;) {
        const int count = std::min(rows.height - done, impl.band.height() - impl.band_rows);
        impl.take(rows, done, count);
        done += count;
        const bool all = impl.next_row == grid.height;
        if (impl.band_rows < impl.band.height() && !all) continue;
        const int end_strip =
            all ? grid.strips : std::min(grid.strips, impl.first_strip + impl.band_rows - 1);
        impl.integrate_band(end_strip);
        // The last row of this band is the first of the next.
        for (int c = 0; c < 3; ++c) {
            std::copy_n(impl.band.row(impl.band_rows - 1, c), grid.width, impl.band.row(0, c));
        }
        impl.band_rows = 1;
        impl.first_strip = end_strip;
    }
}

CubeMap LatLongToCube::finish() {
    Impl& impl = *impl_;
    if (impl.next_row < impl.grid.height || impl.finished) {
        throw InvalidArgument("rows", std::to_string(impl.next_row),
                              impl.finished ? "the map was already taken"
                                            : "must be " + std::to_string(impl.grid.height) +
                                                  " before the map is finished");
    }
    impl.finished = true;
    Image& sums = impl.cube.stacked();
    parallel_for(static_cast<std::size_t>(sums.height()), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        const float* area = impl.areas.row(y, 0);
        for (int c = 0; c < 3; ++c) {
            float* values = sums.row(y, c);
            for (int x = 0; x < sums.width(); ++x) values[x] /= area[x];
        }
    });
    return std::move(impl.cube);
}

CubeMap cube_from_lat_long(const ConstImageView& picture, int cube_size,
                           const EnvironmentTransform& transform, EnvironmentReport* report) {
    LatLongToCube resampler(picture.width, picture.height, cube_size, transform);
    resampler.add_rows(0, picture);
    if (report != nullptr) *report = resampler.report();
    return resampler.finish();
}

}  // namespace aureole::ibl
