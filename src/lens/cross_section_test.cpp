#include "aureole/lens/cross_section.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/units.h"
#include "aureole/lens/glass.h"
#include "aureole/lens/library.h"
#include "aureole/lens/paraxial.h"
#include "lens/cross_section_parts.h"

namespace aureole::lens {
namespace {

template <class Item>
std::vector<Item> items(const Drawing& drawing) {
    std::vector<Item> result;
    for (const auto& item : drawing.items) {
        if (const auto* one = std::get_if<Item>(&item)) result.push_back(*one);
    }
    return result;
}

bool same_ink(const DrawingColor& a, const DrawingColor& b) {
    return a.red == b.red && a.green == b.green && a.blue == b.blue;
}

// A drawing without legend, measured back into mm of the lens by what must be true of any: the
// image plane is its heaviest line, and stands at sensor_z; the front vertex of a convex lens is
// the leftmost point of glass.
class Measured {
  public:
    Measured(const Lens& lens, CrossSectionOptions options) : options_(std::move(options)) {
        options_.legend = false;
        drawing = cross_section(lens, options_);
        double left = HUGE_VAL;
        for (const DrawingArea& area : items<DrawingArea>(drawing)) {
            if (area.outline_width_mm == 0) continue;
            glass.push_back(area.points);
            for (const DrawingPoint& point : area.points) left = std::min(left, point.x_mm);
        }
        DrawingLine plane;
        plane.width_mm = 0;
        for (const DrawingLine& line : items<DrawingLine>(drawing)) {
            if (line.width_mm > plane.width_mm) plane = line;
        }
        scale_ = (plane.points[0].x_mm - left) / lens.sensor_z_mm();
        left_ = left;
        axis_ = 0.5 * (plane.points[0].y_mm + plane.points[1].y_mm);
    }

    SectionPoint at(const DrawingPoint& point) const {
        return {(point.x_mm - left_) / scale_, (axis_ - point.y_mm) / scale_};
    }

    // Rays in one ink: those that pass, or those that were ended.
    std::vector<std::vector<SectionPoint>> lines(const DrawingColor& ink, bool faint) const {
        std::vector<std::vector<SectionPoint>> result;
        for (const DrawingLine& line : items<DrawingLine>(drawing)) {
            if (!same_ink(line.color, ink) || (line.color.opacity < ink.opacity) != faint) continue;
            result.emplace_back();
            for (const DrawingPoint& point : line.points) result.back().push_back(at(point));
        }
        return result;
    }
    std::vector<std::vector<SectionPoint>> rays(std::size_t field, bool faint) const {
        return lines(field_color(field, options_), faint);
    }

    Drawing drawing;
    std::vector<std::vector<DrawingPoint>> glass;

  private:
    CrossSectionOptions options_;
    double scale_ = 1, left_ = 0, axis_ = 0;
};

Lens shipped(const std::string& id, double f_number = 0) {
    return Lens(shipped_lens(id), {.f_number = f_number});
}

TEST(CrossSection, GlassIsWhereTheTableSaysInTrueProportion) {
    const Lens lens = shipped("heliar");
    const Measured measured(lens, {.rays_per_field = 0});
    // Faces from 0; their elements: 0-1, 1-2, 3-4, 6-7, 7-8.
    const int fronts[] = {0, 1, 3, 6, 7};
    ASSERT_EQ(measured.glass.size(), 5U);
    for (std::size_t e = 0; e < 5; ++e) {
        const Face& front = lens.faces()[static_cast<std::size_t>(fronts[e])];
        const Face& back = lens.faces()[static_cast<std::size_t>(fronts[e]) + 1];
        double widest = 0;
        int on_front = 0;
        int on_back = 0;
        for (const DrawingPoint& point : measured.glass[e]) {
            const SectionPoint p = measured.at(point);
            widest = std::max(widest, std::abs(p.y_mm));
            // On a sphere c (z^2 + y^2) = 2 z about the vertex; or on the flat or the edge.
            const auto on = [&](const Face& face) {
                const double z = p.z_mm - face.z_mm;
                const double c = face.curvature_per_mm;
                return std::abs(p.y_mm) <= face.semi_aperture_mm + 1e-9 &&
                       std::abs(c * (z * z + p.y_mm * p.y_mm) - 2 * z) < 1e-9;
            };
            on_front += on(front) ? 1 : 0;
            on_back += on(back) ? 1 : 0;
        }
        EXPECT_NEAR(widest, std::max(front.semi_aperture_mm, back.semi_aperture_mm), 1e-9);
        EXPECT_GT(on_front, 60);
        EXPECT_GT(on_back, 60);
        EXPECT_GE(on_front + on_back + 4, static_cast<int>(measured.glass[e].size()));
    }
}

TEST(CrossSection, RaysOfOneAngleMeetAtTheirImage) {
    const Lens lens = shipped("heliar");
    const Measured measured(lens, {.field_angles_deg = {0, 10, -5}, .rays_per_field = 9});
    const double angles[] = {0, 10, -5};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto rays = measured.rays(i, false);
        EXPECT_EQ(rays.size(), 9U);
        for (const auto& ray : rays) {
            // Where it comes from, every face, the sensor.
            EXPECT_EQ(ray.size(), lens.faces().size() + 2);
            EXPECT_NEAR(ray.back().z_mm, lens.sensor_z_mm(), 1e-9);
            // Light from above arrives below; aberrations of this lens stay within 0.3 mm.
            EXPECT_NEAR(ray.back().y_mm, -lens.efl_mm() * std::tan(rad_from_deg(angles[i])), 0.3);
            const double slope = (ray[1].y_mm - ray[0].y_mm) / (ray[1].z_mm - ray[0].z_mm);
            EXPECT_NEAR(slope, -std::tan(rad_from_deg(angles[i])), 1e-9);
        }
    }
}

TEST(CrossSection, RaysFillTheStopAndThoseBesideItEndThere) {
    const Lens lens = shipped("heliar", 16);
    const Measured measured(lens, {.rays_per_field = 11});
    const auto stop = static_cast<std::size_t>(lens.stop());
    const double stop_z = lens.faces()[stop].z_mm;
    double low = 0;
    double high = 0;
    for (const auto& ray : measured.rays(0, false)) {
        ASSERT_GT(ray.size(), stop + 1);
        EXPECT_NEAR(ray[stop + 1].z_mm, stop_z, 1e-9);
        low = std::min(low, ray[stop + 1].y_mm);
        high = std::max(high, ray[stop + 1].y_mm);
    }
    EXPECT_NEAR(high, lens.stop_radius_mm(), 1e-5);
    EXPECT_NEAR(low, -lens.stop_radius_mm(), 1e-5);
    const auto ended = measured.rays(0, true);
    EXPECT_EQ(ended.size(), 12U);
    for (const auto& ray : ended) {
        EXPECT_NEAR(ray.back().z_mm, stop_z, 1e-9);
        EXPECT_GT(std::abs(ray.back().y_mm), lens.stop_radius_mm());
    }
}

TEST(CrossSection, RaysThatHousingsEndReachTheirRims) {
    const Lens lens = shipped("nikon-28-75");
    const Measured measured(lens, {.field_angles_deg = {0, 15}, .rays_per_field = 9});
    int ended = 0;
    for (const std::size_t field : {0U, 1U}) {
        for (const auto& ray : measured.rays(field, true)) {
            const SectionPoint end = ray.back();
            // Those that the frame cut before are not told apart by where they end.
            if (std::abs(end.y_mm) > 1.05 * lens.faces()[0].semi_aperture_mm) continue;
            ++ended;
            const auto faces = lens.faces();
            EXPECT_TRUE(std::any_of(faces.begin(), faces.end(),
                                    [&](const Face& face) {
                                        return std::abs(rim_z_mm(face) - end.z_mm) < 1e-9 &&
                                               std::abs(end.y_mm) > face.semi_aperture_mm;
                                    }))
                << "a ray ends at z = " << end.z_mm << ", y = " << end.y_mm;
        }
    }
    EXPECT_GE(ended, 12);
}

TEST(CrossSection, AGhostGoesBackOnceAndLandsWhereLinearOpticsSays) {
    // Stopped far down, so that rays stay near the axis.
    const Lens lens = shipped("heliar", 180);
    int followed = 0;
    for (const Bounces& ghost : enumerate_ghosts(lens, GhostSet::kAll)) {
        CrossSectionOptions options;
        options.ghost = ghost;
        options.rays_per_field = 3;
        const Measured measured(lens, options);
        SCOPED_TRACE(testing::Message() << "ghost " << ghost.far + 1 << "," << ghost.near + 1);
        const auto back = measured.lines(kGhostBackColor, false);
        ASSERT_EQ(back.size(), 3U);
        for (const auto& way : back) {
            EXPECT_EQ(way.size(), static_cast<std::size_t>(ghost.far - ghost.near) + 1);
            EXPECT_GT(way.front().z_mm, way.back().z_mm);
        }
        // The lines in the ghost's colour: three in, three out, and the lines to the numbers.
        const Meridians to_sensor = ghost_matrices(lens, ghost, kLineDNm).to_sensor;
        std::vector<double> in;
        std::vector<double> out;
        for (const auto& way : measured.lines(kGhostColor, false)) {
            if (way.back().z_mm > lens.sensor_z_mm() - 1e-9) out.push_back(way.back().y_mm);
            if (way.size() == static_cast<std::size_t>(ghost.far) + 2) in.push_back(way[0].y_mm);
        }
        // A ghost larger than the frame leaves it.
        if (out.size() != 3 || in.size() != 3) continue;
        ++followed;
        for (std::size_t i = 0; i < 3; ++i) {
            // 0.3 mm from the axis, where the steepest radius is 28 mm: linear to a few (0.3 /
            // 28)^2.
            EXPECT_NEAR(out[i], to_sensor.y.a * in[i], 1e-3 * std::abs(out[i]) + 1e-9);
        }
    }
    EXPECT_GE(followed, 24);
}

TEST(CrossSection, CylindersAreFlatAlongTheirAxis) {
    Prescription table = shipped_lens("biconvex");
    const auto spread = [&](Profile profile) {
        for (Surface& row : table.surfaces) {
            if (row.radius_mm != 0) row.profile = profile;
        }
        const Lens lens(table);
        double left = HUGE_VAL;
        double right = -HUGE_VAL;
        for (const SectionPoint& point : face_curve(lens.faces()[1], 5)) {
            left = std::min(left, point.z_mm);
            right = std::max(right, point.z_mm);
        }
        return right - left;
    };
    const double radius = std::abs(table.surfaces[1].radius_mm);
    ASSERT_GT(radius, 0);
    const double sag = radius - std::sqrt(radius * radius - 25);
    EXPECT_NEAR(spread(Profile::kRotational), sag, 1e-9);
    EXPECT_EQ(spread(Profile::kCylinderX), 0);
}

TEST(CrossSection, EverythingOfEveryLensIsOnTheSheet) {
    for (const ShippedLens& shipped : shipped_lenses()) {
        const Prescription table = shipped_lens(shipped.id);
        std::vector<std::string> names = {""};
        for (const Position& position : table.positions) names.push_back(position.name);
        for (const std::string& name : names) {
            const Lens lens(table, {.position = name});
            CrossSectionOptions options;
            options.field_angles_deg = {0, 8, -35, 80};
            options.ghost = enumerate_ghosts(lens, GhostSet::kAll).back();
            const Drawing drawing = cross_section(lens, options);
            SCOPED_TRACE(std::string(shipped.id) + " " + name);
            EXPECT_EQ(drawing.title, table.name);
            EXPECT_LT(drawing.height_mm, drawing.width_mm);
            const auto check = [&](const DrawingPoint& point) {
                ASSERT_GE(point.x_mm, 0);
                ASSERT_LE(point.x_mm, drawing.width_mm);
                ASSERT_GE(point.y_mm, 0);
                ASSERT_LE(point.y_mm, drawing.height_mm);
            };
            for (const auto& area : items<DrawingArea>(drawing)) {
                std::for_each(area.points.begin(), area.points.end(), check);
            }
            for (const auto& line : items<DrawingLine>(drawing)) {
                std::for_each(line.points.begin(), line.points.end(), check);
            }
            for (const auto& text : items<DrawingText>(drawing)) check(text.position);
        }
    }
}

TEST(CrossSection, SaysWhatItDraws) {
    const Lens lens = shipped("heliar", 8);
    CrossSectionOptions options;
    options.field_angles_deg = {0, 12.5};
    options.ghost = Bounces{4, 2};
    const Drawing drawing = cross_section(lens, options);
    std::string all;
    for (const DrawingText& text : items<DrawingText>(drawing)) all += text.text + "\n";
    for (const char* words : {"Heliar", "f = 99.24 mm", "f/8", "12.5°", "ghost 5,3", "1.7"}) {
        EXPECT_THAT(all, testing::HasSubstr(words));
    }
    options.title = "Another name";
    EXPECT_EQ(cross_section(lens, options).title, "Another name");
}

TEST(CrossSection, WhatCannotBeDrawnIsNamed) {
    const Lens lens = shipped("heliar");
    const auto refuse = [&](const CrossSectionOptions& options, const std::string& words) {
        try {
            cross_section(lens, options);
            ADD_FAILURE() << "accepted: " << words;
        } catch (const InvalidArgument& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr(words));
        }
    };
    refuse({.field_angles_deg = {0, 90}}, "field angle = 90: must be in (-90, 90)");
    refuse({.field_angles_deg = {std::nan("")}}, "field angle = nan");
    refuse({.field_angles_deg = std::vector<double>(33, 1.0)}, "field angles = 33");
    refuse({.rays_per_field = -1}, "rays_per_field = -1");
    refuse({.rays_per_field = 1001}, "rays_per_field = 1001");
    refuse({.sheet_width_mm = 10}, "sheet_width_mm = 10");
    refuse({.ghost = Bounces{5, 2}}, "ghost = 6,3: ");
    refuse({.ghost = Bounces{2, 4}}, "ghost = 3,5: ");
    refuse({.ghost = Bounces{9, 2}}, "ghost = 10,3: ");
}

}  // namespace
}  // namespace aureole::lens
