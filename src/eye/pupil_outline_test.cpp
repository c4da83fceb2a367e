// Pupils that are not round: area, axes, lids, and the light that they let spread.
#include "eye/pupil_outline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>

#include "aureole/base/error.h"
#include "aureole/base/units.h"
#include "aureole/eye/eye_psf.h"
#include "aureole/eye/motion.h"
#include "aureole/wave/diffraction.h"

namespace aureole::eye {
namespace {

constexpr wave::ApertureGrid kGrid = {1024, 10};

Eye eye_with(PupilShape shape, double diameter_mm, double rotation_deg = 0) {
    Eye eye;
    eye.pupil_diameter_mm = diameter_mm;
    eye.anatomy.pupil = {.shape = shape, .axis_ratio = 2.5, .rotation_deg = rotation_deg};
    return eye;
}

std::vector<Eye> eyes_of_all_shapes() {
    std::vector<Eye> eyes;
    for (const auto shape : {PupilShape::kRound, PupilShape::kSlit, PupilShape::kEllipse}) {
        for (const double diameter_mm : {1.0, 3.0, 6.0, 8.9, 9.0}) {
            for (const double rotation_deg : {0.0, 25.0, -90.0}) {
                eyes.push_back(eye_with(shape, diameter_mm, rotation_deg));
            }
        }
    }
    return eyes;
}

TEST(PupilForm, HasTheAreaOfItsDiameterWhateverTheShape) {
    for (const Eye& eye : eyes_of_all_shapes()) {
        const double disc = kPi * eye.pupil_diameter_mm * eye.pupil_diameter_mm / 4;
        EXPECT_NEAR(wave::area_mm2(draw_pupil(eye, kGrid)) / disc, 1, 1e-3);
    }
}

// The tips of a slit stay where they are; every pupil is round when it fills the iris.
TEST(PupilForm, SlitsOpenSidewaysAndAllBecomeRound) {
    double narrower = 0;
    for (const double diameter_mm : {1.0, 2.0, 5.0, 8.0}) {
        const PupilAxes axes = pupil_axes(eye_with(PupilShape::kSlit, diameter_mm));
        EXPECT_EQ(axes.long_mm, 9) << diameter_mm;
        EXPECT_GT(axes.short_mm, narrower) << diameter_mm;
        narrower = axes.short_mm;
    }
    // A thin slit is two parabolas: 2/3 of length times width.
    EXPECT_NEAR(pupil_axes(eye_with(PupilShape::kSlit, 1)).short_mm, kPi / 4 / (9 * 2.0 / 3), 1e-4);
    const PupilAxes small = pupil_axes(eye_with(PupilShape::kEllipse, 4));
    EXPECT_NEAR(small.long_mm / small.short_mm, 2.5, 1e-12);
    const PupilAxes wide = pupil_axes(eye_with(PupilShape::kEllipse, 8));
    EXPECT_EQ(wide.long_mm, 9);
    EXPECT_NEAR(wide.short_mm, 64.0 / 9, 1e-12);
    for (const auto shape : {PupilShape::kSlit, PupilShape::kEllipse}) {
        // Continuous there.
        EXPECT_NEAR(pupil_axes(eye_with(shape, 8.9999)).short_mm, 9, 2e-3);
        EXPECT_EQ(pupil_axes(eye_with(shape, 9)).short_mm, 9);
    }
}

// Extents, radii and chords against the outline as it is drawn.
TEST(PupilForm, GeometryIsThatOfTheDrawnOutline) {
    for (const Eye& eye : eyes_of_all_shapes()) {
        const PupilOutline outline(eye);
        double width = 0;
        double height = 0;
        double longest = 0;
        const auto points = outline.shape().outlines.front();
        for (const wave::Point& p : points) {
            const double r = std::hypot(p.x_mm, p.y_mm);
            ASSERT_NEAR(outline.radius_mm(std::atan2(p.y_mm, p.x_mm)), r, 1e-4);
            const auto [low, high] = outline.vertical_chord(p.x_mm);
            if (high > low) {
                ASSERT_LT(std::min(std::abs(p.y_mm - low), std::abs(p.y_mm - high)), 0.03);
            }
            width = std::max(width, p.x_mm);
            height = std::max(height, p.y_mm);
            longest = std::max(longest, r);
        }
        EXPECT_NEAR(outline.half_width_mm(), width, 2e-4);
        EXPECT_NEAR(outline.half_height_mm(), height, 2e-4);
        EXPECT_NEAR(outline.longest_radius_mm(), longest, 2e-4);
    }
}

TEST(PupilForm, LidsCloseEveryShapeFromEdgeToEdge) {
    for (Eye eye : eyes_of_all_shapes()) {
        if (eye.pupil_diameter_mm < 3) continue;
        const double full = wave::area_mm2(draw_pupil(eye, kGrid));
        for (const double closure : {0.2, 0.6}) {
            eye.eyelid = closure;
            EXPECT_NEAR(open_share(eye), wave::area_mm2(draw_pupil(eye, kGrid)) / full, 4e-3)
                << closure << " of " << eye.pupil_diameter_mm;
        }
    }
}

// |F|^2 of the drawn pupil relative to its centre, at k samples of frequency along x or y.
struct FarField {
    explicit FarField(const Eye& eye) : field(wave::field_from(draw_pupil(eye, kGrid))) {
        fourier::Fft2d fft(kGrid.samples, kGrid.samples);
        wave::transform(field, fft);
    }
    double at(int k, int l) const {
        const auto n = static_cast<std::size_t>(kGrid.samples);
        const auto wrapped = [&](int i) {
            return static_cast<std::size_t>((i + kGrid.samples)) % n;
        };
        const std::size_t index = wrapped(l) * n + wrapped(k);
        return std::norm(std::complex<double>(field.re[index], field.im[index])) /
               std::norm(std::complex<double>(field.re[0], field.im[0]));
    }
    wave::Field field;
};

// The Airy pattern of a disc, squeezed as the ellipse is stretched.
TEST(PupilFormDiffraction, EllipseIsAnAiryPatternScaledPerAxis) {
    Eye eye = eye_with(PupilShape::kEllipse, 3, 30);
    eye.anatomy.pupil_irregularity = 0;
    const FarField far(eye);
    const PupilAxes axes = pupil_axes(eye);
    for (const auto& [k, l] : {std::pair{3, 0}, {0, 3}, {5, 2}, {-4, 6}, {12, -9}}) {
        const double c = std::cos(kPi / 6);
        const double s = std::sin(kPi / 6);
        const double along = (k * c + l * s) * axes.long_mm / kGrid.extent_mm;
        const double across = (l * c - k * s) * axes.short_mm / kGrid.extent_mm;
        const double u = kPi * std::hypot(along, across);
        const double airy = 2 * std::cyl_bessel_j(1.0, u) / u;
        EXPECT_NEAR(far.at(k, l), airy * airy, 2e-4) << k << " " << l;
    }
}

// Along an axis the far field is the transform of the chords across it, which two circles give.
TEST(PupilFormDiffraction, SlitIsTheTransformOfItsChords) {
    Eye eye = eye_with(PupilShape::kSlit, 3);
    eye.anatomy.pupil_irregularity = 0;
    const FarField far(eye);
    const PupilAxes axes = pupil_axes(eye);
    const double w = axes.short_mm;
    const double h = axes.long_mm;
    const double radius = (h * h + w * w) / (4 * w);
    const double offset = radius - w / 2;
    const auto spectrum = [](double half_mm, int k, const std::function<double(double)>& chord) {
        constexpr int kSteps = 20000;
        double sum = 0;
        double total = 0;
        for (int i = 0; i < kSteps; ++i) {
            const double x = half_mm * (2 * (i + 0.5) / kSteps - 1);
            sum += chord(x) * std::cos(2 * kPi * k * x / kGrid.extent_mm);
            total += chord(x);
        }
        return std::pow(sum / total, 2);
    };
    const auto high = [&](double x) {
        return 2 * std::sqrt(radius * radius - std::pow(std::abs(x) + offset, 2));
    };
    const auto wide = [&](double y) { return 2 * (std::sqrt(radius * radius - y * y) - offset); };
    for (const int k : {1, 2, 3, 5, 8, 13, 21}) {
        EXPECT_NEAR(far.at(k, 0), spectrum(w / 2, k, high), 2e-4) << k;
        EXPECT_NEAR(far.at(0, k), spectrum(h / 2, k, wide), 2e-4) << k;
    }
    // Ten times as wide across as along: light spreads sideways.
    EXPECT_GT(far.at(8, 0), 50 * far.at(0, 8));
}

TEST(PupilFormDiffraction, IsAsSymmetricAsThePupil) {
    for (const auto shape : {PupilShape::kSlit, PupilShape::kEllipse}) {
        Eye eye = eye_with(shape, 4);
        eye.anatomy.pupil_irregularity = 0;
        const FarField far(eye);
        for (const auto& [k, l] : {std::pair{4, 3}, {11, 2}, {7, 20}}) {
            EXPECT_NEAR(far.at(k, l), far.at(-k, l), 1e-7);
            EXPECT_NEAR(far.at(k, l), far.at(k, -l), 1e-7);
        }
        // A quarter turn of the pupil turns the pattern.
        eye.anatomy.pupil.rotation_deg = 90;
        const FarField turned(eye);
        for (const auto& [k, l] : {std::pair{4, 3}, {11, 2}}) {
            EXPECT_NEAR(turned.at(-l, k), far.at(k, l), 1e-5);
        }
    }
}

// The halo is calibrated on round pupils; others uncover the fibres that lie within their outline.
TEST(PupilForm, HaloFollowsTheFibresThatAreUncovered) {
    const double narrow = halo_weight(eye_with(PupilShape::kRound, 3));
    const double slit = halo_weight(eye_with(PupilShape::kSlit, 3));
    EXPECT_EQ(narrow, 0);
    EXPECT_GT(slit, 1e-4);                                          // its ends reach them
    EXPECT_LT(slit, halo_weight(eye_with(PupilShape::kRound, 9)));  // its waist does not
    // Equal to the round one where it is round, and continuous before.
    EXPECT_EQ(halo_weight(eye_with(PupilShape::kSlit, 9)), 0.0062);
    EXPECT_NEAR(halo_weight(eye_with(PupilShape::kSlit, 8.99)), 0.0062, 1e-5);
    // Fibres within 3.2 mm do not care how far an ellipse reaches beyond them.
    Eye long_one = eye_with(PupilShape::kEllipse, 8.5);
    EXPECT_NEAR(halo_weight(long_one), 0.0062, 1e-5);
}

TEST(PupilForm, KeepsTheEnergyOfThePsf) {
    for (const auto shape : {PupilShape::kSlit, PupilShape::kEllipse}) {
        const Eye eye = eye_with(shape, 4);
        EyePsfOptions options;
        options.aperture = {1024, 10};
        const wave::Psf psf = eye_psf(eye, {129, 129, 0.0345, Projection::kPerspective}, options);
        for (int c = 0; c < 3; ++c) {
            double sum = psf.off_kernel_energy[static_cast<std::size_t>(c)];
            for (std::size_t i = 0; i < psf.kernel.pixels(); ++i) {
                sum += static_cast<double>(psf.kernel.plane(c)[i]);
            }
            EXPECT_NEAR(sum, 1, 1e-4);
        }
    }
}

TEST(PupilForm, RefusesWhatCannotBe) {
    Eye eye = eye_with(PupilShape::kEllipse, 4);
    eye.anatomy.pupil.axis_ratio = 0.5;
    EXPECT_THROW(check(eye), InvalidArgument);
    eye.anatomy.pupil = {.shape = PupilShape::kSlit, .iris_mm = 10};
    EXPECT_THROW(check(eye), InvalidArgument);
    eye.anatomy.pupil = {.shape = PupilShape::kSlit, .rotation_deg = 200};
    EXPECT_THROW(check(eye), InvalidArgument);
}

}  // namespace
}  // namespace aureole::eye
