#include "aureole/lens/flare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "aureole/base/error.h"
#include "aureole/lens/library.h"

namespace aureole::lens {
namespace {

View small_view() { return View::from_fov(96, 64, 20, Projection::kPerspective); }

sources::Light some_light(const View& view) {
    return sources::light_at(view, 70, 20, {1e5F, 1e5F, 1e5F});
}

double sum(const Image& picture) {
    double sum = 0;
    for (int c = 0; c < picture.channels(); ++c) {
        for (std::size_t i = 0; i < picture.pixels(); ++i) sum += picture.plane(c)[i];
    }
    return sum;
}

TEST(Flare, PlacementsAreWhereOneGhostIsDrawn) {
    const Lens lens(shipped_lens("heliar"), {.f_number = 22});
    const View view = View::from_fov(480, 320, 40, Projection::kPerspective);
    const sources::Light light = sources::light_at(view, 241, 159, {1e5F, 1e5F, 1e5F});
    FlareOptions options;
    options.method = GhostMethod::kMatrix;
    Flare all(lens, Iris(), view, options);
    int compared = 0;
    for (const GhostPlacement& placed : all.place(light)) {
        const double radius = std::abs(placed.radius_x_px);
        if (radius < 4 || std::abs(placed.center_x - 240) + radius > 230 ||
            std::abs(placed.center_y - 160) + radius > 150) {
            continue;
        }
        for (const Bounces& bounces : enumerate_ghosts(lens, GhostSet::kAll)) {
            options.ghosts.push_back({.bounces = bounces, .enabled = bounces == placed.bounces});
        }
        Image picture(view.width, view.height, 3);
        Flare(lens, Iris(), view, options).render({&light, 1}, picture);
        options.ghosts.clear();
        double energy = 0;
        double x = 0;
        double y = 0;
        for (int j = 0; j < view.height; ++j) {
            for (int i = 0; i < view.width; ++i) {
                const double value = picture.at(i, j, 0);
                energy += value;
                x += value * (i + 0.5);
                y += value * (j + 0.5);
            }
        }
        ASSERT_GT(energy, 0);
        // Housings may cut a ghost, but never make it more than the iris.
        const double share = energy / (placed.radiance[0] * 3.14159265 * radius * radius);
        EXPECT_LT(share, 1.02);
        if (share < 0.98) continue;
        EXPECT_NEAR(x / energy, placed.center_x, 0.25);
        EXPECT_NEAR(y / energy, placed.center_y, 0.25);
        ++compared;
    }
    EXPECT_GT(compared, 2);
}

TEST(Flare, GainsAndTintsScaleGhosts) {
    const Lens lens(shipped_lens("tessar"), {.f_number = 8});
    const View view = small_view();
    const sources::Light light = some_light(view);
    const auto render = [&](const FlareOptions& options) {
        Image picture(view.width, view.height, 3);
        Flare(lens, Iris(), view, options).render({&light, 1}, picture);
        return picture;
    };
    FlareOptions options;
    options.method = GhostMethod::kMatrix;
    options.energy_dropped = 0;
    const Image plain = render(options);
    options.tint = {2, 0, 1};
    const Image tinted = render(options);
    for (std::size_t i = 0; i < plain.pixels(); ++i) {
        EXPECT_NEAR(tinted.plane(0)[i], 2 * plain.plane(0)[i], 1e-4F * plain.plane(0)[i] + 1e-6F);
        EXPECT_EQ(tinted.plane(1)[i], 0);
    }
    options.tint = {1, 1, 1};
    for (const Bounces& bounces : enumerate_ghosts(lens, GhostSet::kAll)) {
        options.ghosts.push_back({.bounces = bounces, .enabled = false});
    }
    EXPECT_EQ(sum(render(options)), 0);
}

TEST(Flare, WhatIsWrongIsNamed) {
    const Lens lens(shipped_lens("tessar"));
    const auto message = [&](const FlareOptions& options) -> std::string {
        try {
            Flare(lens, Iris(), small_view(), options);
        } catch (const InvalidArgument& error) {
            return error.what();
        }
        return "no error";
    };
    EXPECT_NE(message({.look = Look::kBlog}).find("matrix"), std::string::npos);
    EXPECT_NE(message({.wavelengths = 65}).find("65"), std::string::npos);
    EXPECT_NE(message({.rays_per_side = 4}).find("[8, 1024]"), std::string::npos);
    EXPECT_NE(message({.energy_dropped = std::numeric_limits<double>::quiet_NaN()})
                  .find("energy_dropped"),
              std::string::npos);
    EXPECT_NE(message({.ghosts = {{.bounces = {99, 3}}}}).find("100"), std::string::npos);
    EXPECT_THROW(ghost_method_from_name("magic"), InvalidArgument);
}

// Asks to stop after so many reports.
class StopAfter : public Progress {
  public:
    explicit StopAfter(int reports) : left_(reports) {}
    void report(std::string_view, double fraction) override {
        EXPECT_GE(fraction, last);
        last = fraction;
        --left_;
        ++count;
    }
    bool cancelled() const override { return left_ <= 0; }

    double last = 0;
    int count = 0;

  private:
    int left_;
};

TEST(Flare, CanBeStoppedWithinALight) {
    const Lens lens(shipped_lens("tessar"));
    const View view = small_view();
    const std::array lights = {some_light(view), sources::light_at(view, 20, 50, {1, 1, 1})};
    for (const GhostMethod method :
         {GhostMethod::kMatrix, GhostMethod::kTraced, GhostMethod::kHybrid}) {
        FlareOptions options;
        options.method = method;
        options.energy_dropped = 0;
        options.hybrid_tolerance = 1e-3;
        options.wavelengths = 2;
        Flare flare(lens, Iris(), view, options);
        Image whole(view.width, view.height, 3);
        StopAfter never(1000);
        flare.render(lights, whole, &never);
        EXPECT_EQ(never.last, 1);
        // Both lights and the end, and with rays more than that.
        EXPECT_GE(never.count, method == GhostMethod::kMatrix ? 3 : 6);
        EXPECT_GT(sum(whole), 0);
        for (int reports = 0; reports < never.count; ++reports) {
            Image picture(view.width, view.height, 3);
            StopAfter progress(reports);
            EXPECT_THROW(flare.render(lights, picture, &progress), Cancelled);
            EXPECT_EQ(progress.count, reports);
            EXPECT_EQ(sum(picture), 0);
            EXPECT_EQ(flare.report().rays, 0U);
            for (const GhostReport& ghost : flare.report().ghosts) EXPECT_EQ(ghost.energy, 0);
        }
        // Nothing is left of what was stopped.
        Image again(view.width, view.height, 3);
        flare.render(lights, again);
        for (int c = 0; c < 3; ++c) {
            EXPECT_TRUE(
                std::equal(again.plane(c), again.plane(c) + again.pixels(), whole.plane(c)));
        }
    }
}

}  // namespace
}  // namespace aureole::lens
