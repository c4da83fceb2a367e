#include "glare/raster_kernel.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "aureole/base/parallel.h"

namespace aureole::glare {
namespace {

// What the raster's nodes have in common along one axis: sum over pixels of hat(x, 0) hat(x + d, 0)
// for |d| < 2 scale, at index d + 2 scale - 1.
std::vector<double> overlaps(int scale) {
    std::vector<double> hat;
    for (int i = 0; i < 2 * scale; ++i) hat.push_back(1 - std::abs((i + 0.5) / scale - 1));
    std::vector<double> sums(static_cast<std::size_t>(4 * scale - 1), 0.0);
    for (std::size_t i = 0; i < hat.size(); ++i) {
        for (std::size_t j = 0; j < hat.size(); ++j)
            sums[j + hat.size() - 1 - i] += hat[i] * hat[j];
    }
    return sums;
}

// Solves G x = line in place, G the overlaps of neighbouring nodes. At the ends what G would take
// from beyond is taken from the last node itself, so that sums change by the same factor
// everywhere.
class OverlapSolver {
  public:
    OverlapSolver(int scale, int length) : pivots_(static_cast<std::size_t>(length)) {
        const std::vector<double> overlap = overlaps(scale);
        const double self = overlap[static_cast<std::size_t>(2 * scale - 1)];
        beside_ = overlap[static_cast<std::size_t>(3 * scale - 1)];
        for (std::size_t i = 0; i < pivots_.size(); ++i) {
            pivots_[i] = self;
            if (i == 0 || i + 1 == pivots_.size()) pivots_[i] += beside_;
            if (i > 0) pivots_[i] -= beside_ * beside_ / pivots_[i - 1];
        }
    }
    void solve(std::vector<double>& line) const {
        for (std::size_t i = 1; i < line.size(); ++i) {
            line[i] -= beside_ / pivots_[i - 1] * line[i - 1];
        }
        line.back() /= pivots_.back();
        for (std::size_t i = line.size() - 1; i-- > 0;) {
            line[i] = (line[i] - beside_ * line[i + 1]) / pivots_[i];
        }
    }

  private:
    double beside_ = 0;
    std::vector<double> pivots_;  // of the elimination
};

// One axis of the projection: `count` samples of a line become `nodes` nodes about its centre.
class LineProjection {
  public:
    // Nodes beyond the kernel's end, where what they have in common has faded.
    static constexpr int kFade = 8;

    LineProjection(int count, int scale)
        : count_(count),
          scale_(scale),
          half_((count / 2 + 2 * scale - 1) / scale + kFade),
          overlap_(overlaps(scale)),
          solver_(scale, nodes()) {}

    int nodes() const { return 2 * half_ + 1; }

    // `samples`: count of them; `line`: nodes() of them.
    void run(const float* samples, std::vector<double>& line) const {
        for (int j = 0; j < nodes(); ++j) {
            const int first = count_ / 2 + (j - half_) * scale_ - (2 * scale_ - 1);
            const int begin = std::max(0, -first);
            const int end = std::min(4 * scale_ - 1, count_ - first);
            double sum = 0;
            for (int i = begin; i < end; ++i) {
                sum +=
                    overlap_[static_cast<std::size_t>(i)] * static_cast<double>(samples[first + i]);
            }
            line[static_cast<std::size_t>(j)] = sum;
        }
        solver_.solve(line);
        solver_.solve(line);
    }

  private:
    int count_;
    int scale_;
    int half_;
    std::vector<double> overlap_;
    OverlapSolver solver_;
};

// Each row becomes a column of nodes.
Image projected_rows(const Image& image, int scale) {
    const LineProjection projection(image.width(), scale);
    constexpr int kRows = 16;  // at a time: whole cache lines of the result
    Image result(image.height(), projection.nodes(), image.channels());
    const int blocks = (image.height() + kRows - 1) / kRows;
    parallel_for(static_cast<std::size_t>(blocks), [&](std::size_t block, int) {
        const int y0 = static_cast<int>(block) * kRows;
        const int count = std::min(kRows, image.height() - y0);
        std::vector<double> line(static_cast<std::size_t>(projection.nodes()));
        std::vector<float> lines(line.size() * kRows);
        for (int c = 0; c < image.channels(); ++c) {
            for (int i = 0; i < count; ++i) {
                projection.run(image.row(y0 + i, c), line);
                for (std::size_t j = 0; j < line.size(); ++j) {
                    lines[j * kRows + static_cast<std::size_t>(i)] = static_cast<float>(line[j]);
                }
            }
            for (int j = 0; j < projection.nodes(); ++j) {
                std::copy_n(lines.data() + j * kRows, count, result.row(j, c) + y0);
            }
        }
    });
    return result;
}

}  // namespace

Image raster_kernel(const Image& far, int scale) {
    return projected_rows(projected_rows(far, scale), scale);
}

}  // namespace aureole::glare
