#include "aureole/wave/radial_grating.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <string>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/units.h"

namespace aureole::wave {
namespace {

// Angles are counted in turns. Both functions look up the nearest of some thousand nodes and
// continue by a short series; errors are below 1e-11.
class Trigonometry {
  public:
    Trigonometry() {
        for (int k = 0; k <= kNodes; ++k) {
            const auto index = static_cast<std::size_t>(k);
            arc_[index] = std::atan(static_cast<double>(k) / kNodes);
            cos_[index] = std::cos(2 * kPi * k / kNodes);
            sin_[index] = std::sin(2 * kPi * k / kNodes);
        }
    }

    // Angle of (x, y) in (-1/2, 1/2] turns; (0, 0) gives 0.
    double turns(double x, double y) const {
        const double ax = std::abs(x);
        const double ay = std::abs(y);
        const double large = std::max(ax, ay);
        if (large == 0) return 0;
        const double t = std::min(ax, ay) / large;
        const int k = static_cast<int>(t * kNodes + 0.5);
        const double node = static_cast<double>(k) / kNodes;
        const double z = (t - node) / (1 + t * node);
        double angle = arc_[static_cast<std::size_t>(k)] + z - z * z * z / 3;
        if (ay > ax) angle = kPi / 2 - angle;
        if (x < 0) angle = kPi - angle;
        return (y < 0 ? -angle : angle) * (0.5 / kPi);
    }

    struct CosSin {
        double c;
        double s;
    };
    // Of t turns, |t| < 1e6.
    CosSin cos_sin(double t) const {
        constexpr double kBias = 1 << 20;
        const double scaled = (t + kBias) * kNodes + 0.5;
        const auto whole = static_cast<std::int64_t>(scaled);
        const auto k = static_cast<std::size_t>(whole & (kNodes - 1));
        const double d = (t + kBias - static_cast<double>(whole) / kNodes) * (2 * kPi);
        const double c = 1 - d * d * 0.5;
        const double s = d - d * d * d * (1.0 / 6);
        return {cos_[k] * c - sin_[k] * s, sin_[k] * c + cos_[k] * s};
    }

  private:
    static constexpr int kNodes = 1024;
    std::array<double, kNodes + 1> arc_;
    std::array<double, kNodes + 1> cos_;
    std::array<double, kNodes + 1> sin_;
};

// Coefficients d_k of t = sum_k d_k cos(k u) at equal steps of radius.
struct RadialSeries {
    static constexpr int kNodes = 1024;
    int harmonics = 0;  // highest k
    double inner_mm = 0;
    double nodes_per_mm = 0;
    std::vector<float> re;  // node-major, harmonics + 1 each
    std::vector<float> im;

    explicit RadialSeries(const RadialGrating& grating)
        : inner_mm(grating.inner_radius_mm),
          nodes_per_mm(kNodes / (grating.full_radius_mm - grating.inner_radius_mm)) {
        // |J_k(a)| <= (a/2)^k / k!: stop below what a float resolves. An absorbing line adds one.
        double bound = 1;
        while (bound > 2e-8) bound *= grating.phase_rad / 2 / ++harmonics;
        if (grating.opacity > 0) ++harmonics;

        using Complex = std::complex<double>;
        std::vector<Complex> c(static_cast<std::size_t>(harmonics) + 2);
        for (int node = 0; node <= kNodes; ++node) {
            const double s = static_cast<double>(node) / kNodes;
            const double w = s * s * (3 - 2 * s);
            Complex factor = 1;  // 2 i^k, without the 2 for k = 0
            for (std::size_t k = 0; k < c.size(); ++k) {
                c[k] = factor * std::cyl_bessel_j(static_cast<double>(k), grating.phase_rad * w);
                factor = k == 0 ? Complex(0, 2) : factor * Complex(0, 1);
            }
            // Times (p + q cos u): cos u cos(k u) = (cos((k+1) u) + cos((k-1) u)) / 2.
            const double p = 1 - grating.opacity * w / 2;
            const double q = -grating.opacity * w / 2;
            for (std::size_t k = 0; k + 1 < c.size(); ++k) {
                const Complex below = k == 0 ? 0.0 : (k == 1 ? 2.0 * c[0] : c[k - 1]);
                const Complex d = p * c[k] + q / 2 * (below + c[k + 1]);
                re.push_back(static_cast<float>(d.real()));
                im.push_back(static_cast<float>(d.imag()));
            }
        }
    }
};

// Jitter at an angle, and its slope per radian.
class Jitter {
  public:
    explicit Jitter(const std::vector<float>& values) : values_(values) {
        if (!values_.empty()) values_.push_back(values_.front());
    }
    struct Sample {
        double value;
        double slope;
    };
    Sample at(double turns) const {
        if (values_.empty()) return {0, 0};
        const auto count = static_cast<double>(values_.size() - 1);
        const double position = std::clamp((turns + 0.5) * count, 0.0, count);
        const auto k = std::min(static_cast<std::size_t>(position), values_.size() - 2);
        const double step = static_cast<double>(values_[k + 1]) - static_cast<double>(values_[k]);
        const double fraction = position - static_cast<double>(k);
        return {static_cast<double>(values_[k]) + fraction * step, step * count / (2 * kPi)};
    }

  private:
    std::vector<float> values_;
};

void check(const RadialGrating& g) {
    const auto require = [](bool ok, const char* what, double value, const char* allowed) {
        if (!ok) throw InvalidArgument(what, std::to_string(value), allowed);
    };
    require(g.fibres > 0 && g.fibres < 1e5, "lens fibres", g.fibres, "must be in (0, 100000)");
    require(g.phase_rad >= 0 && g.phase_rad <= 30, "grating phase (rad)", g.phase_rad,
            "must be in [0, 30]");
    require(g.opacity >= 0 && g.opacity <= 1, "grating opacity", g.opacity, "must be in [0, 1]");
    require(g.inner_radius_mm >= 0, "grating inner radius (mm)", g.inner_radius_mm,
            "must not be negative");
    require(g.full_radius_mm > g.inner_radius_mm && std::isfinite(g.full_radius_mm),
            "grating full radius (mm)", g.full_radius_mm, "must exceed the inner radius");
}

class SampleMean {
  public:
    SampleMean(const RadialGrating& grating, double spacing_mm)
        : series_(grating),
          jitter_(grating.jitter_rad),
          fibres_(grating.fibres),
          half_mm_(spacing_mm / 2) {}

    // Mean of t over the sample at (x, y), r its radius (> 0).
    std::complex<float> at(double x, double y, double r) const {
        const double turns = trigonometry_.turns(x, y);
        const Jitter::Sample jitter = jitter_.at(turns);
        const double u = fibres_ * turns + jitter.value * (0.5 / kPi);
        // Local frequency of u: (fibres + jitter') / r along the azimuth; half a sample of it.
        const double frequency = (fibres_ + jitter.slope) / (r * r) * half_mm_;
        const double ax = nonzero(frequency * y);
        const double ay = nonzero(frequency * x);
        const auto wave = trigonometry_.cos_sin(u);
        const auto sx = trigonometry_.cos_sin(ax * (0.5 / kPi));
        const auto sy = trigonometry_.cos_sin(ay * (0.5 / kPi));
        const double area = 1 / (ax * ay);

        const double position = std::min((r - series_.inner_mm) * series_.nodes_per_mm,
                                         static_cast<double>(RadialSeries::kNodes));
        const int node = std::min(static_cast<int>(position), RadialSeries::kNodes - 1);
        const auto blend = static_cast<float>(position - node);
        const int terms = series_.harmonics + 1;
        const std::size_t base = static_cast<std::size_t>(node) * static_cast<std::size_t>(terms);
        const float* re = series_.re.data() + base;
        const float* im = series_.im.data() + base;

        // cos(k u), sin(k ax), sin(k ay) by the recurrence of multiple angles.
        double cos_now = wave.c, cos_before = 1;
        double sx_now = sx.s, sx_before = 0;
        double sy_now = sy.s, sy_before = 0;
        float sum_re = re[0] + blend * (re[terms] - re[0]);
        float sum_im = im[0] + blend * (im[terms] - im[0]);
        for (int k = 1; k < terms; ++k) {
            const auto harmonic = static_cast<float>(cos_now * sx_now * sy_now * area / (k * k));
            sum_re += (re[k] + blend * (re[k + terms] - re[k])) * harmonic;
            sum_im += (im[k] + blend * (im[k + terms] - im[k])) * harmonic;
            advance(cos_now, cos_before, 2 * wave.c);
            advance(sx_now, sx_before, 2 * sx.c);
            advance(sy_now, sy_before, 2 * sy.c);
        }
        return {sum_re, sum_im};
    }

  private:
    // sin(k a)/(k a) at 0 is its value at 1e-5.
    static double nonzero(double a) { return std::abs(a) < 1e-5 ? 1e-5 : a; }
    static void advance(double& now, double& before, double twice_cosine) {
        const double next = twice_cosine * now - before;
        before = now;
        now = next;
    }

    Trigonometry trigonometry_;
    RadialSeries series_;
    Jitter jitter_;
    double fibres_;
    double half_mm_;
};

}  // namespace

void multiply_radial_grating(Field& field, const RadialGrating& grating) {
    check(grating);
    const ApertureGrid& grid = field.grid;
    const int n = grid.samples;
    const SampleMean mean(grating, grid.spacing_mm());
    parallel_for(static_cast<std::size_t>(n), [&](std::size_t j, int) {
        float* re = field.re.data() + j * static_cast<std::size_t>(n);
        float* im = field.im.data() + j * static_cast<std::size_t>(n);
        const double y = grid.y_mm(static_cast<int>(j));
        for (int i = 0; i < n; ++i) {
            if (re[i] == 0 && im[i] == 0) continue;
            const double x = grid.x_mm(i);
            const double r2 = x * x + y * y;
            if (r2 <= grating.inner_radius_mm * grating.inner_radius_mm) continue;
            const std::complex<float> t = mean.at(x, y, std::sqrt(r2));
            const float a = re[i];
            const float b = im[i];
            re[i] = a * t.real() - b * t.imag();
            im[i] = a * t.imag() + b * t.real();
        }
    });
}

double grating_period_mm(double fibres, double radius_mm) { return 2 * kPi * radius_mm / fibres; }

}  // namespace aureole::wave
