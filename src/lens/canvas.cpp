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

void Canvas::clear() noexcept {
    for (const CanvasLevel& level : levels_) {
        for_rows(-level.margin, level.height + level.margin, [&](int y) {
            RowSpan& span = level.used[y];
            if (span.empty()) return;
            // Vectors may have written behind the span, not more than the padding.
            const int end = std::min(span.end, level.width + level.margin);
            for (float* plane : level.planes) {
                float* row = plane + y * level.stride;
                std::fill(row + span.begin, row + end + CanvasLevel::kPadding, 0.0F);
            }
            span = {};
        });
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
    for_rows(0, out.height, [&](int y) { kernels.add_row(levels_[0], coarse, out, y); });
}

}  // namespace aureole::lens
