#include "lens/canvas.h"

#include "aureole/base/parallel.h"
#include "lens/canvas_kernels.h"

namespace aureole::lens {
namespace {

constexpr int kMaxLevels = 8;
constexpr int kSmallest = 8;      // pixels across the shorter side of the last level
constexpr int kRowsPerTask = 16;  // of a parallel loop

std::size_t tasks_for(int rows) {
    return static_cast<std::size_t>((rows + kRowsPerTask - 1) / kRowsPerTask);
}

void clear_row(const CanvasLevel& level, int y) {
    RowSpan& span = level.used[y];
    if (span.empty()) return;
    // Vectors may have written behind the span, not more than the padding.
    const int end = std::min(span.end, level.width + level.margin) + CanvasLevel::kPadding;
    for (float* plane : level.planes) {
        float* row = plane + y * level.stride;
        std::fill(row + span.begin, row + end, 0.0F);
    }
    span = {};
}

// Calls body(row) for rows [first, last), in parallel.
template <class Body>
void for_rows(int first, int last, const Body& body) {
    parallel_for(tasks_for(last - first), [&](std::size_t task, int) {
        const int begin = first + static_cast<int>(task) * kRowsPerTask;
        const int end = std::min(begin + kRowsPerTask, last);
        for (int y = begin; y < end; ++y) body(y);
    });
}

}  // namespace

Canvas::Canvas(int width, int height) {
    for (int l = 0; l < kMaxLevels; ++l) {
        CanvasLevel level;
        level.width = (width + (1 << l) - 1) >> l;
        level.height = (height + (1 << l) - 1) >> l;
        if (l > 0 && std::min(level.width, level.height) < kSmallest) break;
        level.margin = kMargin;
        level.level = l;
        // Rows begin on cache lines but for the margin, and end with the padding.
        level.stride = (level.width + 2 * kMargin + CanvasLevel::kPadding + 15) / 16 * 16;
        const auto rows = static_cast<std::size_t>(level.height + 2 * kMargin);
        const std::size_t plane = rows * static_cast<std::size_t>(level.stride);
        // In front of the first row too: interpolation reads one pixel before a margin.
        memory_.emplace_back(3 * plane + 16);
        std::fill(memory_.back().data(), memory_.back().data() + memory_.back().size(), 0.0F);
        for (std::size_t p = 0; p < 3; ++p) {
            level.planes[p] =
                memory_.back().data() + 16 + p * plane + kMargin * level.stride + kMargin;
        }
        used_.emplace_back(rows);
        level.used = used_.back().data() + kMargin;
        levels_.push_back(level);
    }
}

void Canvas::clear() noexcept { clear_from(0); }

void Canvas::clear_from(std::size_t first_level) noexcept {
    for (std::size_t l = first_level; l < levels_.size(); ++l) {
        const CanvasLevel& level = levels_[l];
        for_rows(-level.margin, level.height + level.margin, [&](int y) { clear_row(level, y); });
    }
}

void Canvas::mark_used(int l) noexcept {
    const CanvasLevel& level = levels_[static_cast<std::size_t>(l)];
    for (int y = -level.margin; y < level.height + level.margin; ++y) {
        level.mark_used(y, -level.margin, level.width + level.margin);
    }
}

void Canvas::add_to(const ImageView& out) noexcept {
    const CanvasKernels kernels = canvas_kernels();
    for (std::size_t l = levels_.size() - 1; l > 1; --l) {
        const CanvasLevel& fine = levels_[l - 1];
        for_rows(-fine.margin, fine.height + fine.margin,
                 [&](int y) { kernels.refine_row(levels_[l], fine, y); });
    }
    const CanvasLevel* coarse = levels_.size() > 1 ? &levels_[1] : nullptr;
    // The rows of the picture are cleared while they are in the cache.
    const CanvasLevel& finest = levels_[0];
    for_rows(-finest.margin, finest.height + finest.margin, [&](int y) {
        if (y >= 0 && y < out.height) kernels.add_row(finest, coarse, out, y);
        clear_row(finest, y);
    });
    clear_from(1);
}

}  // namespace aureole::lens
