// Numerical integration of smooth functions over short intervals.
#pragma once

namespace aureole::eye {

// Gauss-Legendre with 4 points: exact for polynomials up to degree 7 (Abramowitz & Stegun 25.4.30).
inline constexpr double kGaussNodes[4] = {-0.8611363115940526, -0.3399810435848563,
                                          0.3399810435848563, 0.8611363115940526};
inline constexpr double kGaussWeights[4] = {0.3478548451374538, 0.6521451548625461,
                                            0.6521451548625461, 0.3478548451374538};

template <class Function>
double gauss_legendre(const Function& f, double from, double to) {
    const double centre = 0.5 * (from + to);
    const double half = 0.5 * (to - from);
    double sum = 0;
    for (int i = 0; i < 4; ++i) sum += kGaussWeights[i] * f(centre + half * kGaussNodes[i]);
    return sum * half;
}

// The mean of f(x, y) over the rectangle.
template <class Function>
double gauss_legendre_mean(const Function& f, double x0, double x1, double y0, double y1) {
    const auto line = [&](double y) {
        return gauss_legendre([&](double x) { return f(x, y); }, x0, x1);
    };
    return gauss_legendre(line, y0, y1) / ((x1 - x0) * (y1 - y0));
}

}  // namespace aureole::eye
