// Where the nodes of a kernel that changes over the picture lie along one axis, and how long the
// transforms are that convolve their shares of the picture.
#pragma once

#include "fourier/line_plan.h"

namespace aureole::fourier {

// The pixels to which a node gives weight: all between its neighbours.
struct Support {
    int first;
    int size;
};
Support support(int node, int pixels, int nodes);

// Offsets of `reach` around the support, cyclically: nothing falls back into the pixels wanted if
// the line holds support and both reaches, nor, wherever the support lies, if it holds the picture
// and one (convolver.h). Nodes at the border have half the support of those within.
struct NodeAxis {
    NodeAxis(int pixels, int nodes, int kernel_reach);

    const LinePlan& plan(int node) const {
        return node == 0 || node == nodes - 1 ? border : within;
    }
    int longest() const { return within.length > border.length ? within.length : border.length; }

    int pixels;
    int nodes;
    int reach;  // of the kernel, cut to what can be seen
    LinePlan within;
    LinePlan border;
    int largest = 0;  // support of a node

  private:
    int needed(int node) const;
};

// Where the source pixels of a node are, and where its light goes.
struct NodeSpan {
    NodeSpan(const NodeAxis& axis, int node);

    const LinePlan* plan;
    Support source;
    int first;  // pixel that the light reaches
    int size;   // pixels that it reaches
};

}  // namespace aureole::fourier
