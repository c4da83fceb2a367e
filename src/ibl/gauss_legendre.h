// Gauss-Legendre quadrature.
#pragma once

#include <vector>

namespace aureole::ibl {

// Over [-1, 1]; the weights sum to 2.
struct GaussRule {
    std::vector<double> nodes;  // rising
    std::vector<double> weights;

    int points() const { return static_cast<int>(nodes.size()); }
};

// points >= 1. Exact for polynomials up to degree 2 points - 1.
GaussRule gauss_legendre(int points);

}  // namespace aureole::ibl
