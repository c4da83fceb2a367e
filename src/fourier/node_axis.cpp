#include "fourier/node_axis.h"

#include <algorithm>
#include <cmath>

namespace aureole::fourier {
namespace {

// convolve_line() needs at least two passes; 12 = 3 * 4 has them, and so has all that is larger.
int padded(int needed) { return best_length(std::max(needed, 12)); }

}  // namespace

Support support(int node, int pixels, int nodes) {
    if (nodes == 1) return {0, pixels};
    const auto position = [&](int n) {
        return static_cast<double>(n) * (pixels - 1) / (nodes - 1);
    };
    const int first = node == 0 ? 0 : static_cast<int>(std::floor(position(node - 1))) + 1;
    const int last =
        node == nodes - 1 ? pixels - 1 : static_cast<int>(std::ceil(position(node + 1))) - 1;
    return {first, last - first + 1};
}

NodeAxis::NodeAxis(int pixel_count, int node_count, int kernel_reach)
    : pixels(pixel_count),
      nodes(node_count),
      reach(std::min(kernel_reach, pixels - 1)),
      within(needed(nodes / 2)),
      border(needed(0)) {
    // Supports of nodes within differ by a pixel.
    for (int n = 0; n < nodes; ++n) {
        largest = std::max(largest, support(n, pixels, nodes).size);
        LinePlan& plan = n == 0 || n == nodes - 1 ? border : within;
        if (needed(n) > plan.length) plan = LinePlan(needed(n));
    }
}

int NodeAxis::needed(int node) const {
    return padded(std::min(support(node, pixels, nodes).size + 2 * reach, pixels + reach));
}

NodeSpan::NodeSpan(const NodeAxis& axis, int node)
    : plan(&axis.plan(node)),
      source(support(node, axis.pixels, axis.nodes)),
      first(std::max(source.first - axis.reach, 0)),
      size(std::min(source.first + source.size + axis.reach, axis.pixels) - first) {}

}  // namespace aureole::fourier
