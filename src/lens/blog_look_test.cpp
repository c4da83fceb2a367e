// The look of the blog, against its formulas as it prints them.
#include "lens/blog_look.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "aureole/lens/glass.h"
#include "lens/matrix_test_support.h"

namespace aureole::lens {
namespace {

// The document's 2 x 2 matrices, row by row, times (height, angle).
struct DocumentMatrix {
    double m[2][2] = {{1, 0}, {0, 1}};
};
DocumentMatrix product(const DocumentMatrix& a, const DocumentMatrix& b) {
    DocumentMatrix r;
    for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j) r.m[i][j] = a.m[i][0] * b.m[0][j] + a.m[i][1] * b.m[1][j];
    }
    return r;
}
DocumentMatrix translate(double d) { return {{{1, d}, {0, 1}}}; }
DocumentMatrix refract(double n1, double n2, double radius) {
    return {{{1, 0}, {radius == 0 ? 0 : (n1 - n2) / (radius * n2), n1 / n2}}};
}
DocumentMatrix reflect(double radius) { return {{{1, 0}, {radius == 0 ? 0 : 2 / radius, 1}}}; }

// M_a and M_s M_a of a ghost whose light meets the stop once.
struct DocumentSystem {
    DocumentMatrix to_stop, whole;
};
DocumentSystem document_system(const Lens& lens, const Bounces& bounces) {
    const auto faces = lens.faces();
    const std::vector<double> n = lens.indices(kLineDNm);
    const auto radius = [&](int k) {
        const double c = faces[static_cast<std::size_t>(k)].curvature_per_mm;
        return c == 0 ? 0.0 : 1 / c;
    };
    const auto z = [&](int k) { return faces[static_cast<std::size_t>(k)].z_mm; };
    const auto index = [&](int k) { return n[static_cast<std::size_t>(k)]; };
    DocumentSystem system;
    DocumentMatrix& m = system.whole;
    const auto meet = [&](int k, const DocumentMatrix& acts) {
        if (k == lens.stop()) system.to_stop = m;
        m = product(acts, m);
    };
    const int count = static_cast<int>(faces.size());
    int at = 0;
    const auto forwards_to = [&](int end) {
        for (; at < end; ++at) {
            meet(at, refract(index(at), index(at + 1), radius(at)));
            m = product(translate((at + 1 < count ? z(at + 1) : lens.sensor_z_mm()) - z(at)), m);
        }
    };
    if (!bounces.direct()) {
        forwards_to(bounces.far);
        meet(at, reflect(radius(at)));
        for (--at; at > bounces.near; --at) {
            m = product(translate(z(at + 1) - z(at)), m);
            meet(at, refract(index(at + 1), index(at), -radius(at)));
        }
        m = product(translate(z(at + 1) - z(at)), m);
        meet(at, reflect(-radius(at)));
        m = product(translate(z(at + 1) - z(at)), m);
        ++at;
    }
    forwards_to(count);
    return system;
}

// As printed, in double precision.
double document_reflectance(double lambda, double d, double theta1, double n1, double n2,
                            double n3) {
    const double theta2 = std::asin(n1 * std::sin(theta1) / n2);
    const double theta3 = std::asin(n1 * std::sin(theta1) / n3);
    const double cos1 = std::cos(theta1);
    const double cos2 = std::cos(theta2);
    const double cos3 = std::cos(theta3);
    const double beta = 2 * kPi / lambda * n2 * d * cos2;
    const auto airy = [&](double r12, double r23) {
        const double phase = 2 * r12 * r23 * std::cos(2 * beta);
        return (r12 * r12 + r23 * r23 + phase) / (1 + r12 * r12 * r23 * r23 + phase);
    };
    const double rp = airy((n2 * cos1 - n1 * cos2) / (n2 * cos1 + n1 * cos2),
                           (n3 * cos2 - n2 * cos3) / (n3 * cos2 + n2 * cos3));
    const double rs = airy((n1 * cos1 - n2 * cos2) / (n1 * cos1 + n2 * cos2),
                           (n2 * cos2 - n3 * cos3) / (n2 * cos2 + n3 * cos3));
    return 0.5 * (rs + rp);
}

double document_color(const Lens& lens, const Bounces& bounces, double lambda) {
    const double theta = BlogLook::random_angle(lens, bounces);
    double color = 1;
    for (const int face : {bounces.far, bounces.near}) {
        const std::vector<double> n = lens.indices(lambda);
        const std::vector<double> n_d = lens.indices(kLineDNm);
        const auto k = static_cast<std::size_t>(face);
        if (lens.faces()[k].coating.empty()) {  // cemented: bare
            color *= document_reflectance(lambda, 0, theta, n[k], n[k], n[k + 1]);
            continue;
        }
        const double n2 = std::max(std::sqrt(n_d[k] * n_d[k + 1]), 1.38);
        color *= document_reflectance(lambda, 550 / 4.0 / n2, theta, n[k], n2, n[k + 1]);
    }
    return color;
}

double saturate(double x) { return std::clamp(x, 0.0, 1.0); }
double document_smax(double a, double b, double k) {
    const double diff = a - b;
    const double h = saturate(0.5 + 0.5 * diff / k);
    return b + h * (diff + k * (1.0 - h));
}
double document_smoothstep(double a, double b, double x) {
    const double t = saturate((x - a) / (b - a));
    return t * t * (3 - 2 * t);
}

TEST(BlogLook, GhostsAreThoseOfTheDocument) {
    const Lens lens(shipped_lens("nikon-28-75"));
    const View view = test_view(lens, 960, 540);
    FlareOptions options;
    options.look = Look::kBlog;
    options.set = GhostSet::kSameSide;
    MatrixScene scene(lens, view, Iris({.blades = 8, .rotation_deg = 22.5}), options);
    const double tangent = 0.12;
    const sources::Light light = test_light(view, 0.8 * tangent, 0.6 * tangent);
    scene.ghosts.place(light);

    const double theta = std::atan(tangent);
    const double h_a = lens.stop_radius_mm();
    const double h_e = lens.faces().front().semi_aperture_mm;
    const DocumentSystem image = document_system(lens, Bounces{});
    const double entrance_pupil = h_a / image.to_stop.m[0][0];
    for (std::size_t g = 0; g < scene.list.size(); ++g) {
        const MatrixGhost& ghost = scene.ghosts.placements()[g];
        const DocumentSystem system = document_system(lens, scene.list[g]);
        const auto& ma = system.to_stop.m;
        const double h_e1 = (h_a - ma[0][1] * theta) / ma[0][0];
        const double h_e2 = (-h_a - ma[0][1] * theta) / ma[0][0];
        const double h_p1 = system.whole.m[0][0] * h_e1 + system.whole.m[0][1] * theta;
        const double h_p2 = system.whole.m[0][0] * h_e2 + system.whole.m[0][1] * theta;
        const double radius_mm = std::abs(h_p1 - h_p2) / 2;
        if (radius_mm < scene.film.mm_per_px) continue;  // kept from vanishing
        const double center_px = (h_p1 + h_p2) / 2 / scene.film.mm_per_px;
        const double slack = 1e-4 * std::abs(center_px) + 1e-3;
        EXPECT_NEAR(ghost.center_x, view.axis_x + 0.8 * center_px, slack) << g;
        EXPECT_NEAR(ghost.center_y, view.axis_y - 0.6 * center_px, slack) << g;
        EXPECT_NEAR(ghost.radius_px * scene.film.mm_per_px / radius_mm, 1, 1e-5) << g;

        const double radius = radius_mm / 21.65;
        double intensity = (h_e1 - h_e2) * (h_e1 - h_e2) / (4 * entrance_pupil * entrance_pupil);
        intensity /= 4 * radius * radius;
        for (std::size_t c = 0; c < 3; ++c) {
            // The area of the light's image in focus, in squared radii of the image circle.
            const double in_focus =
                light.solid_angle_sr * lens.efl_mm() * lens.efl_mm() / (21.65 * 21.65);
            const double expected =
                static_cast<double>(light.radiance[c]) * in_focus * intensity *
                document_color(lens, scene.list[g], BlogLook::kWavelengthsNm[c]);
            EXPECT_NEAR(static_cast<double>(ghost.radiance[c]) / expected, 1, 1e-4)
                << g << " colour " << c;
        }

        const double e_a1 = ma[0][0] * h_e + ma[0][1] * theta;
        const double e_a2 = -ma[0][0] * h_e + ma[0][1] * theta;
        const double c_e = (e_a1 + e_a2) * 0.5 / h_a;
        const double r_e = std::abs(e_a1 - e_a2) * 0.5 / h_a;
        for (int point = 0; point < 50; ++point) {
            const double u = -0.98 + 0.04 * point;
            const double v = 0.9 * std::sin(2.7 * point);
            double distance = -1e9;
            for (int axis = 0; axis < 8; ++axis) {
                const double angle = rad_from_deg(22.5 + 22.5 * (2 * axis + 1));
                const double along = std::cos(angle) * u + std::sin(angle) * v;
                distance = axis == 0 ? along : document_smax(distance, along, 0.1);
            }
            const double clip = std::hypot(u - c_e * 0.8, v - c_e * 0.6) / r_e;
            const double mask = document_smoothstep(0.95, 0.80, document_smax(distance, clip, 0.1));
            const auto x = static_cast<float>(ghost.center_x + u / ghost.u_per_px);
            const auto y = static_cast<float>(ghost.center_y + v / ghost.v_per_px);
            // The field is sampled at 64 x 64 points; it bends at the blades' joints.
            EXPECT_NEAR(ghost.coverage(scene.iris, x, y), mask, 0.06) << g;
        }
    }
}

TEST(BlogLook, PixelsAddUpToTheEnergy) {
    const Lens lens(shipped_lens("heliar"), {.f_number = 8});
    const View view = test_view(lens, 900, 700, 120);
    FlareOptions options;
    options.look = Look::kBlog;
    MatrixScene scene(lens, view, Iris({.blades = 6}), options);
    scene.ghosts.place(test_light(view, 0.02, 0.01));
    int compared = 0;
    int blocked = 0;
    for (std::size_t g = 0; g < scene.list.size(); ++g) {
        const MatrixGhost ghost = scene.ghosts.placements()[g];
        // Both reflections on one side of the stop.
        const bool same_side =
            (scene.list[g].near < lens.stop()) == (scene.list[g].far < lens.stop());
        blocked += !same_side;
        EXPECT_EQ(same_side, ghost.energy > 0);
        const double reach = 1.1 * static_cast<double>(ghost.radius_px);
        if (reach < 20 || ghost.center_x < reach || ghost.center_x > 900 - reach ||
            ghost.center_y < reach || ghost.center_y > 700 - reach) {
            continue;
        }
        for (const int level : {0, 1}) {
            const double sum = sum_of(scene.draw({{static_cast<int>(g), level}}));
            EXPECT_NEAR(sum / static_cast<double>(ghost.energy), 1, 0.01) << g;
        }
        ++compared;
    }
    EXPECT_GT(compared, 3);
    EXPECT_GT(blocked, 3);
}

TEST(BlogLook, AnglesAreStableAndBelowTheCriticalOne) {
    const Lens lens(shipped_lens("nikon-28-75"));
    double least = 1;
    double most = 0;
    for (const Bounces& bounces : enumerate_ghosts(lens, GhostSet::kAll)) {
        const double angle = BlogLook::random_angle(lens, bounces);
        EXPECT_EQ(angle, BlogLook::random_angle(lens, bounces));
        least = std::min(least, angle);
        most = std::max(most, angle);
        for (const double index : lens.indices(450)) EXPECT_LT(index * std::sin(angle), 1.02);
    }
    EXPECT_LT(least, 0.02);
    EXPECT_GT(most, 0.5);
}

}  // namespace
}  // namespace aureole::lens
