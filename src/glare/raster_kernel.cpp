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
        for (std::size_t j = 0; j < hat.size(); ++j) sums[j + hat.size() - 1 - i] += hat[i] * hat[j];
    }
    return sums;
}

// Solves G x = line in place, G the overlaps of neighbouring nodes. At the ends what G would take
// from beyond is taken from the last node itself, so that sums change by the same factor everywhere.
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

    // sample(i) for i in [0, count) to node(j, value) for j in [0, nodes).
    template <class Sample, class Node>
    void run(const Sample& sample, const Node& node) const {
        std::vector<double> line(static_cast<std::size_t>(nodes()), 0.0);
        for (int j = 0; j < nodes(); ++j) {
            const int first = count_ / 2 + (j - half_) * scale_ - (2 * scale_ - 1);
            const int begin = std::max(0, -first);
            const int end = std::min(4 * scale_ - 1, count_ - first);
            double sum = 0;
            for (int i = begin; i < end; ++i) {
                sum += overlap_[static_cast<std::size_t>(i)] * sample(first + i);
            }
            line[static_cast<std::size_t>(j)] = sum;
        }
        solver_.solve(line);
        solver_.solve(line);
        for (int j = 0; j < nodes(); ++j) node(j, line[static_cast<std::size_t>(j)]);
    }

  private:
    int count_;
    int scale_;
    int half_;
    std::vector<double> overlap_;
    OverlapSolver solver_;
};

}  // namespace

Image raster_kernel(const Image& far, int scale) {
    const LineProjection across(far.width(), scale);
    const LineProjection down(far.height(), scale);
    Image rows(across.nodes(), far.height(), far.channels());
    Image coarse(across.nodes(), down.nodes(), far.channels());
    for (int c = 0; c < far.channels(); ++c) {
        parallel_for(static_cast<std::size_t>(far.height()), [&](std::size_t y, int) {
            const float* from = far.row(static_cast<int>(y), c);
            float* to = rows.row(static_cast<int>(y), c);
            across.run([&](int i) { return static_cast<double>(from[i]); },
                       [&](int j, double value) { to[j] = static_cast<float>(value); });
        });
        parallel_for(static_cast<std::size_t>(coarse.width()), [&](std::size_t column, int) {
            const int x = static_cast<int>(column);
            down.run([&](int i) { return static_cast<double>(rows.at(x, i, c)); },
                     [&](int j, double value) { coarse.at(x, j, c) = static_cast<float>(value); });
        });
    }
    return coarse;
}

}  // namespace aureole::glare
