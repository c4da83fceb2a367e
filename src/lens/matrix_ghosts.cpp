#include "lens/matrix_ghosts.h"

#include <algorithm>
#include <optional>

#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "lens/blog_look.h"
#include "lens/matrix_kernels.h"
#include "lens/matrix_outline.h"
#include "lens/matrix_placement.h"

namespace aureole::lens {
namespace {

constexpr int kRowsPerTask = 16;
// Ghosts whose open radius is smaller than this, in pixels of their level, are drawn with the sum
// that they should have instead of the one that their few pixels happen to give; larger ones that
// are clipped, whose edges cross or run beside each other, too.
constexpr double kLeastUncorrected = 20;
constexpr double kLeastUncorrectedClipped = 32;
// The blur of a large light is as wide at any resolution: its sum is taken where the ghost has
// about this radius, unless the blur is narrower than a pixel there.
constexpr double kRadiusForBlur = 48;
constexpr int kChunk = 128;  // pixels of a row with pictures in the pupil

// What pictures in the pupil leave of pixels [x, x + count) of row y.
void picture_row(const MatrixKernels& kernels, const MatrixDrawing& drawing, int y, int x,
                 int count, float* share) {
    kernels.coverage_row(drawing, y, x, count, share);
    if (drawing.pupil == nullptr) return;
    const Pupil& pupil = *drawing.pupil;
    const MatrixGhost& ghost = *drawing.ghost;
    const float footprint = std::sqrt(std::abs(drawing.du * drawing.dv));
    const float v = (static_cast<float>(y) - drawing.y0) * drawing.dv;
    for (int i = 0; i < count; ++i) {
        if (share[i] <= 0) continue;
        const float u = (static_cast<float>(x + i) - drawing.x0) * drawing.du;
        share[i] *= pupil.pictures(drawing.entrance, u, v, footprint);
        for (int k = 0; k < ghost.clip_count; ++k) {
            const MatrixGhost::Clip& clip = ghost.clips[k];
            if (!clip.iris) continue;
            share[i] *= pupil.iris_picture((u - clip.u0) / clip.ru, (v - clip.v0) / clip.rv,
                                           footprint / std::abs(clip.ru));
        }
    }
}

// Calls body(y, x, count, share) for pieces of rows [begin, end).
template <class Body>
void for_pieces(const MatrixKernels& kernels, const MatrixDrawing& drawing,
                const CanvasLevel& level, int begin, int end, const Body& body) {
    float share[kChunk + 16];
    begin = std::max(begin, drawing.row_begin);
    end = std::min(end, drawing.row_end);
    for (int y = begin; y < end; ++y) {
        const RowSpan any = row_chords(drawing, y, -level.margin, level.width + level.margin).any;
        for (int x = any.begin; x < any.end; x += kChunk) {
            const int count = std::min(kChunk, any.end - x);
            picture_row(kernels, drawing, y, x, count, share);
            body(y, x, count, share);
        }
    }
}

void draw_pictures(const MatrixKernels& kernels, const MatrixDrawing& drawing,
                   const CanvasLevel& level, int begin, int end) {
    for_pieces(kernels, drawing, level, begin, end,
               [&](int y, int x, int count, const float* share) {
                   level.mark_used(y, x, x + count);
                   for (int p = 0; p < 3; ++p) {
                       float* to = level.planes[p] + y * level.stride + x;
                       for (int i = 0; i < count; ++i) to[i] += share[i] * drawing.rgb[p];
                   }
               });
}

// The sum over all pixels of an endless level.
double sum_of(const MatrixKernels& kernels, const MatrixDrawing& drawing) {
    CanvasLevel endless;
    endless.margin = 1 << 26;
    double sum = 0;
    for_pieces(kernels, drawing, endless, drawing.row_begin, drawing.row_end,
               [&](int, int, int count, const float* share) {
                   for (int i = 0; i < count; ++i) sum += static_cast<double>(share[i]);
               });
    return sum;
}

// At which level the pixels of a ghost are summed up, so that it can be drawn at `level` with the
// sum of its open area; -1: nowhere, it has that sum anyway.
int level_for_sum(const MatrixGhost& ghost, int level) {
    double radius = static_cast<double>(ghost.open_radius_px) / (1 << level);
    const bool small =
        radius < (ghost.clip_count > 0 ? kLeastUncorrectedClipped : kLeastUncorrected);
    if (small || ghost.spot) return level;
    float edge = ghost.edge;
    for (int k = 0; k < ghost.clip_count; ++k) {
        edge = std::max(edge, ghost.clips[k].edge * std::abs(ghost.clips[k].ru));
    }
    if (static_cast<double>(edge) * kRadiusForBlur < 1) return -1;
    for (; radius > kRadiusForBlur; radius /= 2) ++level;
    return level;
}

}  // namespace

struct MatrixGhosts::Impl {
    Impl(const Lens& lens, const Iris& lens_iris, const Film& lens_film,
         const FlareOptions& options, std::vector<Bounces> list, const Occluder* lens_occluder)
        : iris(lens_iris),
          film(lens_film),
          ghosts(std::move(list)),
          placements(ghosts.size()),
          entrances(ghosts.size()),
          kernels(matrix_kernels()) {
        if (lens_occluder != nullptr) occluder = *lens_occluder;
        if (!options.ghost_texture.empty()) texture = texture_pyramid(options.ghost_texture);
        pupil = {&iris, texture.empty() ? nullptr : &texture, occluder ? &*occluder : nullptr};
        if (options.look == Look::kBlog) blog.emplace(lens, iris, film, ghosts);
        placement.emplace(lens, film, pupil, blog ? std::span<const Bounces>() : ghosts);
        edges_per_ghost = static_cast<std::size_t>(max_outline_edges(iris));
        drawings.resize(ghosts.size());
        parts.resize(ghosts.size() * kMaxOutlineParts);
        edges.resize(ghosts.size() * edges_per_ghost);
        for (int i = 0; i < max_workers(); ++i) {
            workers.push_back(
                {InsideChanges(-Canvas::kMargin, film.width + 2 * Canvas::kMargin + 1),
                 std::vector<const MatrixDrawing*>(ghosts.size())});
        }
    }

    void prepare(const GhostDraw& draw, std::size_t slot) noexcept;
    // Of one worker.
    struct Scratch {
        InsideChanges changes;
        std::vector<const MatrixDrawing*> drawings;
    };
    void draw_band(const CanvasLevel& level, std::size_t count, int begin, int end,
                   Scratch& scratch) noexcept;

    Iris iris;
    Film film;
    std::vector<Bounces> ghosts;
    TransmissionPyramid texture;
    std::optional<Occluder> occluder;
    Pupil pupil;
    std::optional<BlogLook> blog;
    std::optional<MatrixPlacement> placement;
    std::vector<MatrixGhost> placements;
    std::vector<Entrance> entrances;
    MatrixKernels kernels;
    // Of a draw(): one slot per ghost that is drawn.
    std::size_t edges_per_ghost = 0;
    std::vector<MatrixDrawing> drawings;
    std::vector<OutlinePart> parts;
    std::vector<OutlineEdge> edges;
    std::vector<Scratch> workers;
};

void MatrixGhosts::Impl::prepare(const GhostDraw& draw, std::size_t slot) noexcept {
    const auto index = static_cast<std::size_t>(draw.ghost);
    const MatrixGhost& ghost = placements[index];
    MatrixDrawing& drawing = drawings[slot];
    if (blog) {
        drawing = blog->outline(ghost, draw.level);
        for (int c = 0; c < 3; ++c) drawing.rgb[c] = draw.gain[c] * ghost.radiance[c];
        return;
    }
    const auto outline_at = [&](int level) {
        return outline(ghost, pupil, entrances[index], level, &parts[slot * kMaxOutlineParts],
                       &edges[slot * edges_per_ghost]);
    };
    double correction = 1;
    if (const int level = level_for_sum(ghost, draw.level); level >= 0) {
        const double radius = static_cast<double>(ghost.open_radius_px) / (1 << level);
        const double sum = sum_of(kernels, outline_at(level));
        correction = sum > 0 ? kPi * radius * radius / sum : 0;
    }
    drawing = outline_at(draw.level);
    for (int c = 0; c < 3; ++c) {
        drawing.rgb[c] =
            draw.gain[c] * static_cast<float>(static_cast<double>(ghost.radiance[c]) * correction);
    }
}

void MatrixGhosts::Impl::draw_band(const CanvasLevel& level, std::size_t count, int begin, int end,
                                   Scratch& scratch) noexcept {
    std::size_t plain = 0;
    for (std::size_t slot = 0; slot < count; ++slot) {
        const MatrixDrawing& drawing = drawings[slot];
        if (drawing.level != level.level || drawing.row_begin >= end || drawing.row_end <= begin) {
            continue;
        }
        if (blog) {
            blog->draw_rows(drawing, level, begin, end);
        } else if (drawing.pupil != nullptr) {
            draw_pictures(kernels, drawing, level, begin, end);
        } else {
            scratch.drawings[plain++] = &drawing;
        }
    }
    kernels.draw_rows({scratch.drawings.data(), plain}, level, begin, end, scratch.changes);
}

MatrixGhosts::MatrixGhosts(const Lens& lens, const Iris& iris, const Film& film,
                           const FlareOptions& options, std::vector<Bounces> ghosts,
                           const Occluder* occluder)
    : impl_(std::make_unique<Impl>(lens, iris, film, options, std::move(ghosts), occluder)) {}
MatrixGhosts::~MatrixGhosts() = default;
MatrixGhosts::MatrixGhosts(MatrixGhosts&&) noexcept = default;

void MatrixGhosts::place(const sources::Light& light) noexcept {
    if (impl_->blog) {
        impl_->blog->place(light, impl_->placements);
    } else {
        impl_->placement->place(light, impl_->placements, impl_->entrances);
    }
}

std::span<const MatrixGhost> MatrixGhosts::placements() const noexcept { return impl_->placements; }

void MatrixGhosts::draw(std::span<const GhostDraw> ghosts, Canvas& canvas) noexcept {
    Impl& impl = *impl_;
    const std::size_t count = std::min(ghosts.size(), impl.drawings.size());
    parallel_for(count, [&](std::size_t slot, int) { impl.prepare(ghosts[slot], slot); });
    // Bands of rows of all levels, the coarsest first: they have least to do per row.
    constexpr int kMaxLevels = 32;
    int tasks_before[kMaxLevels + 1] = {};
    for (int l = 0; l < canvas.levels(); ++l) {
        const bool used = std::any_of(ghosts.begin(), ghosts.end(),
                                      [&](const GhostDraw& draw) { return draw.level == l; });
        const int rows = canvas.level(l).height + 2 * canvas.level(l).margin;
        tasks_before[l + 1] =
            tasks_before[l] + (used ? (rows + kRowsPerTask - 1) / kRowsPerTask : 0);
    }
    const int tasks = tasks_before[canvas.levels()];
    parallel_for(static_cast<std::size_t>(tasks), [&](std::size_t index, int worker) {
        const int task = static_cast<int>(index);
        int l = 0;
        while (tasks_before[l + 1] <= task) ++l;
        const CanvasLevel& level = canvas.level(l);
        const int begin = (task - tasks_before[l]) * kRowsPerTask - level.margin;
        const int end = std::min(begin + kRowsPerTask, level.height + level.margin);
        impl.draw_band(level, count, begin, end, impl.workers[static_cast<std::size_t>(worker)]);
    });
}

std::array<double, 3> MatrixGhosts::axial_transmission() const noexcept {
    return impl_->placement->colors().axial_transmission();
}

}  // namespace aureole::lens
