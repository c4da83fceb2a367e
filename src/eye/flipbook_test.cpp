// Flipbooks at a size that bakes in a moment; flipbook_slow_test.cpp has the bars.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/random.h"
#include "aureole/eye/flipbook_bake.h"
#include "aureole/eye/flipbook_player.h"
#include "eye/flipbook_selection.h"
#include "eye/kernel_checks.h"

namespace aureole::eye {
namespace {

const wave::KernelGrid kRaster = {63, 63, 0.15, Projection::kPerspective};

EyePsfOptions small_options() {
    EyePsfOptions options;
    options.aperture = {2048, 10};  // the halo needs 2 deg
    options.spectral.bands = 4;
    return options;
}

FlipbookRange small_range() {
    FlipbookRange range;
    range.pupil_from_mm = 5;
    range.pupil_to_mm = 7;
    range.texture_pupils = 2;
    range.lens_states = 3;
    range.vitreous_phases = 3;
    range.covered_phases = 2;
    range.halo_pupils = 2;
    range.streak_pupils = 2;
    range.lid_states = 2;
    range.largest_closure = 0.5;
    return range;
}

const std::vector<std::byte>& small_book() {
    static const std::vector<std::byte> bytes =
        bake_flipbook(Eye(), kRaster, small_range(), small_options());
    return bytes;
}

wave::Psf played(FlipbookPlayer& player, const Eye& now) {
    wave::Psf psf;
    psf.kernel = Image(player.grid().width, player.grid().height, 3);
    player.write(now, psf);
    return psf;
}

Image term(FlipbookPlayer& player, Component component, const Eye& now) {
    Image image(kRaster.width, kRaster.height, 3);
    player.write_term(component, now, image);
    return image;
}

double rms_difference(const Image& a, const Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < 3 * a.pixels(); ++i) {
        sum += std::pow(static_cast<double>(a.plane(0)[i] - b.plane(0)[i]), 2);
    }
    return std::sqrt(sum / static_cast<double>(3 * a.pixels()));
}

bool identical(const Image& a, const Image& b) {
    return std::memcmp(a.plane(0), b.plane(0), 3 * a.pixels() * sizeof(float)) == 0;
}

class FlipbookTest : public testing::Test {
  protected:
    FlipbookTest() : book(small_book()), player(book, Eye(), small_options().spectral, kRaster) {}

    Flipbook book;
    FlipbookPlayer player;
};

TEST_F(FlipbookTest, HasTheFramesOfItsRange) {
    EXPECT_EQ(book.frames().size(), 2U * (5U + 2U) + 2U * 2U + 2U * 3U);
    EXPECT_EQ(book.frames().size(), frames_of(small_range()).size());
    EXPECT_EQ(book.frames().size(), FlipbookAxes(small_range()).frames);
    EXPECT_EQ(book.grid().width, 63);
    EXPECT_EQ(book.aperture(), small_options().aperture);
    EXPECT_EQ(book.range().vitreous_step_deg, small_range().vitreous_step_deg);
    // Every frame is selected by its own pose, and whole.
    const FlipbookAxes axes(small_range());
    const auto frames = frames_of(small_range());
    for (std::size_t i = 0; i < frames.size(); ++i) {
        Eye now;
        now.pupil_diameter_mm = frames[i].pupil_mm;
        now.eyelid = frames[i].eyelid;
        now.pose = frames[i].pose;
        if (frames[i].component == Component::kCorona) {
            EXPECT_EQ(texture_frame(axes, now), i);
            continue;
        }
        const FlipbookParts parts = frames[i].component == Component::kHalo
                                        ? halo_parts(axes, now)
                                        : streak_parts(axes, now);
        ASSERT_EQ(parts.count, 1U) << i;
        EXPECT_EQ(parts.begin()->frame, i);
        EXPECT_EQ(parts.begin()->factor, 1);
    }
}

TEST_F(FlipbookTest, IsTheDirectPsfAtItsFrames) {
    for (const FlipbookFrame& frame : frames_of(small_range())) {
        if (frame.component != Component::kStreaks) continue;
        Eye now;
        now.pupil_diameter_mm = frame.pupil_mm;
        now.eyelid = frame.eyelid;
        now.pose = frame.pose;
        now.halo = 3;
        now.streaks = 0.7;
        const wave::Psf direct = eye_psf(now, kRaster, small_options());
        const wave::Psf psf = played(player, now);
        double squares = 0;
        double differences = 0;
        for (int c = 0; c < 3; ++c) {
            for (std::size_t i = 0; i < direct.kernel.pixels(); ++i) {
                const auto e = static_cast<double>(player.envelope().plane(0)[i]);
                const auto wanted = static_cast<double>(direct.kernel.plane(c)[i]);
                const auto value = static_cast<double>(psf.kernel.plane(c)[i]);
                squares += std::pow(wanted / e, 2);
                differences += std::pow((value - wanted) / e, 2);
            }
        }
        EXPECT_LT(std::sqrt(differences / squares), 0.01)
            << frame.pupil_mm << " mm, lids " << frame.eyelid;
    }
    for (const FlipbookLids lids : {FlipbookLids::kOpen, FlipbookLids::kCovering}) {
        const FlipbookErrors errors = errors_at_frames(book, Eye(), small_options(), lids, 4);
        EXPECT_EQ(errors.poses, 4);
        EXPECT_LT(errors.worst_ring, 0.01);
    }
}

// Small rasters fade patterns out: they are measured as far as they are whole, or not at all.
TEST(FlipbookErrors, AreThoseOfWholePatterns) {
    wave::KernelGrid raster = kRaster;
    FlipbookRange range;
    range.pupil_from_mm = range.pupil_to_mm = 6;
    range.texture_pupils = range.lens_states = range.vitreous_phases = range.halo_pupils =
        range.streak_pupils = range.lid_states = 1;
    const auto errors = [&] {
        const auto bytes = bake_flipbook(Eye(), raster, range, small_options());
        return errors_at_frames(Flipbook(bytes), Eye(), small_options(), FlipbookLids::kOpen, 1);
    };
    raster.pitch_deg = 0.06;  // 1.9 deg from the source, the last eighth faded
    const FlipbookErrors near_source = errors();
    EXPECT_NEAR(near_source.to_deg, 28 * 0.06, 0.01);
    EXPECT_EQ(near_source.poses, 1);
    EXPECT_LT(near_source.worst_ring, 0.02);
    raster.pitch_deg = 0.3;  // all of the pattern fits
    EXPECT_EQ(errors().to_deg, 5);
    raster.pitch_deg = 0.01;
    EXPECT_EQ(errors().poses, 0);
}

TEST_F(FlipbookTest, EnergySumsToOneInKernelsOfAnySize) {
    Random random(1);
    for (const auto& [width, height] : {std::pair{63, 63}, {151, 101}, {31, 201}, {9, 9}}) {
        wave::KernelGrid grid = kRaster;
        grid.width = width;
        grid.height = height;
        FlipbookPlayer sized(book, Eye(), small_options().spectral, grid);
        for (int i = 0; i < 4; ++i) {
            Eye now;
            now.pupil_diameter_mm = random.uniform(4.5, 7.5);
            now.pose.lash_closure = random.uniform();
            now.eyelid = random.uniform(0, now.pose.lash_closure);
            now.pose.vitreous_yaw_deg = random.uniform(-2, 2);
            now.halo = 20;
            now.streaks = i;
            const wave::Psf psf = played(sized, now);
            const auto sums = plane_sums(psf.kernel);
            for (std::size_t c = 0; c < 3; ++c) {
                EXPECT_NEAR(sums[c] + psf.off_kernel_energy[c], 1, 5e-6) << width << "x" << height;
            }
        }
    }
}

// The part of a large kernel is the small kernel.
TEST_F(FlipbookTest, KernelsOfAllSizesAgree) {
    wave::KernelGrid grid = kRaster;
    grid.width = 101;
    grid.height = 31;
    FlipbookPlayer sized(book, Eye(), small_options().spectral, grid);
    Eye now;
    now.pupil_diameter_mm = 6.2;
    const wave::Psf small = played(player, now);
    const wave::Psf other = played(sized, now);
    for (int c = 0; c < 3; ++c) {
        for (int y = 0; y < 31; ++y) {
            for (int x = 0; x < 63; ++x) {
                const float wanted = small.kernel.at(x, y + 16, c);
                EXPECT_NEAR(other.kernel.at(x + 19, y, c), wanted, 1e-5F * std::abs(wanted));
            }
        }
    }
}

TEST_F(FlipbookTest, TextureIsOneFrameAndNeverABlend) {
    Random random(3);
    const auto frames = frames_of(small_range());
    for (int i = 0; i < 20; ++i) {
        Eye now;
        now.pupil_diameter_mm = random.uniform(5, 7);
        now.eyelid = i % 3 == 0 ? random.uniform(0, 0.6) : 0;
        now.pose.lens_scale = random.uniform(0.998, 1.002);
        now.pose.vitreous_yaw_deg = i < 10 ? 0 : random.uniform(-3, 3);
        now.pose.vitreous_pitch_deg = i < 10 ? 0 : random.uniform(-3, 3);
        const Image texture = term(player, Component::kCorona, now);
        int found = 0;
        for (const FlipbookFrame& frame : frames) {
            if (frame.component != Component::kCorona) continue;
            Eye stored;
            stored.eyelid = frame.eyelid;
            stored.pupil_diameter_mm = frame.pupil_mm;
            stored.pose = frame.pose;
            found += identical(texture, term(player, Component::kCorona, stored)) ? 1 : 0;
        }
        EXPECT_EQ(found, 1);
    }
}

TEST_F(FlipbookTest, HaloAndStreaksAreStraightBetweenFrames) {
    const auto at = [&](Component component, double pupil_mm, double closure, double eyelid) {
        Eye now;
        now.pupil_diameter_mm = pupil_mm;
        now.pose.lash_closure = closure;
        now.eyelid = eyelid;
        return term(player, component, now);
    };
    const auto expect_mix = [](const Image& mix,
                               const std::vector<std::pair<double, Image>>& parts) {
        Image wanted(mix.width(), mix.height(), 3);
        double size = 0;
        for (const auto& [share, image] : parts) {
            for (std::size_t i = 0; i < 3 * mix.pixels(); ++i) {
                wanted.plane(0)[i] += static_cast<float>(share) * image.plane(0)[i];
            }
            size = std::max(size, rms_difference(image, Image(mix.width(), mix.height(), 3)));
        }
        EXPECT_LT(rms_difference(mix, wanted), 1e-5 * size);
        EXPECT_GT(rms_difference(mix, parts.front().second), 0.01 * size);
    };
    expect_mix(at(Component::kHalo, 5.5, 0, 0),
               {{0.75, at(Component::kHalo, 5, 0, 0)}, {0.25, at(Component::kHalo, 7, 0, 0)}});
    expect_mix(at(Component::kHalo, 5, 0, 0.1),
               {{0.8, at(Component::kHalo, 5, 0, 0)}, {0.2, at(Component::kHalo, 5, 0, 0.5)}});
    expect_mix(at(Component::kStreaks, 5, 0.3, 0.1),
               {{0.4, at(Component::kStreaks, 5, 0, 0)},
                {0.6 * 2 / 3, at(Component::kStreaks, 5, 0.5, 0)},
                {0.6 / 3, at(Component::kStreaks, 5, 0.5, 0.5)}});
    // Beyond the range: its end.
    EXPECT_TRUE(identical(at(Component::kStreaks, 8, 0.7, 0), at(Component::kStreaks, 7, 0.5, 0)));
}

TEST_F(FlipbookTest, VitreousPhasesFormALoop) {
    Eye rest;
    const Image still = term(player, Component::kCorona, rest);
    Eye turned = rest;
    turned.pose.vitreous_yaw_deg = 3 * 0.2;
    EXPECT_TRUE(identical(term(player, Component::kCorona, turned), still));
    turned.pose.vitreous_yaw_deg = -3 * 0.2;
    EXPECT_TRUE(identical(term(player, Component::kCorona, turned), still));
    for (double Pose::*axis : {&Pose::vitreous_yaw_deg, &Pose::vitreous_pitch_deg}) {
        for (const double step : {0.2, -0.2}) {
            turned = rest;
            turned.pose.*axis = step;
            EXPECT_FALSE(identical(term(player, Component::kCorona, turned), still));
        }
    }
}

// Behind lids there are other patterns, and what moves in the eye goes on to move them.
TEST_F(FlipbookTest, LidsHaveTheirOwnTextures) {
    Eye lids;
    lids.eyelid = 0.5;
    const Image still = term(player, Component::kCorona, lids);
    EXPECT_FALSE(identical(still, term(player, Component::kCorona, Eye())));
    Eye turned = lids;
    turned.pose.vitreous_yaw_deg = 0.2;
    EXPECT_FALSE(identical(term(player, Component::kCorona, turned), still));
    Eye focused = lids;
    focused.pose.lens_scale = 1.002;
    EXPECT_FALSE(identical(term(player, Component::kCorona, focused), still));
    // Nearer to open: the open ones.
    Eye nearly_open = Eye();
    nearly_open.eyelid = 0.2;
    EXPECT_TRUE(identical(term(player, Component::kCorona, nearly_open),
                          term(player, Component::kCorona, Eye())));
}

// Lids that hide all fibres of a narrow slit leave no halo: an empty frame, not an error.
TEST(Flipbook, LidsMayHideTheWholeHalo) {
    Eye cat;
    cat.anatomy.pupil.shape = PupilShape::kSlit;
    FlipbookRange range = small_range();
    range.pupil_from_mm = 2;
    range.pupil_to_mm = 4;
    range.halo_pupils = 1;
    range.largest_closure = 0.9;
    const auto bytes = bake_flipbook(cat, kRaster, range, small_options());
    const Flipbook book(bytes);
    FlipbookPlayer player(book, cat, small_options().spectral, kRaster);
    cat.pupil_diameter_mm = 4;
    cat.eyelid = 0.9;
    const wave::Psf direct = eye_psf(cat, kRaster, small_options());
    const wave::Psf psf = played(player, cat);
    EXPECT_LT(rms_difference(psf.kernel, direct.kernel),
              0.01 * rms_difference(direct.kernel, Image(63, 63, 3)));
}

TEST_F(FlipbookTest, PlaysTheSameOnAnyNumberOfThreads) {
    Eye now;
    now.pupil_diameter_mm = 6.3;
    now.pose.lash_closure = 0.2;
    const wave::Psf psf = played(player, now);
    const ThreadLimit limit(1);
    EXPECT_TRUE(identical(played(player, now).kernel, psf.kernel));
    EXPECT_EQ(bake_flipbook(Eye(), kRaster, small_range(), small_options()), small_book());
}

// IJspeert's scatter knows the pupil: exact at the pupils of the texture.
TEST(Flipbook, FollowsAScatterThatKnowsThePupil) {
    Eye eye;
    eye.scatter = ScatterModel::kIjspeert;
    const auto bytes = bake_flipbook(eye, kRaster, small_range(), small_options());
    const Flipbook book(bytes);
    FlipbookPlayer player(book, eye, small_options().spectral, kRaster);
    for (const double pupil_mm : {5.0, 7.0}) {
        eye.pupil_diameter_mm = pupil_mm;
        const wave::Psf direct = eye_psf(eye, kRaster, small_options());
        const wave::Psf psf = played(player, eye);
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(psf.off_kernel_energy[c], direct.off_kernel_energy[c], 1e-4);
        }
        for (int x = 0; x < kRaster.width; ++x) {
            EXPECT_NEAR(psf.kernel.at(x, 31, 1), direct.kernel.at(x, 31, 1),
                        0.03F * direct.kernel.at(x, 31, 1));
        }
    }
    // Between them the energy still is whole.
    eye.pupil_diameter_mm = 5.8;
    const wave::Psf psf = played(player, eye);
    const auto sums = plane_sums(psf.kernel);
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(sums[c] + psf.off_kernel_energy[c], 1, 5e-6);
    }
}

TEST(Flipbook, NamesTheFirstValueThatDiffers) {
    const Flipbook book(small_book());
    const SpectralSampling sampling = small_options().spectral;
    EXPECT_FALSE(book.difference(Eye(), sampling).has_value());
    Eye moved;
    moved.pupil_diameter_mm = 3;
    moved.eyelid = 0.3;
    moved.halo = 2;
    moved.streaks = 2;
    moved.pose.lens_scale = 1.001;
    EXPECT_FALSE(book.difference(moved, sampling).has_value());
    Eye older;
    older.age_years = 61;
    const auto difference = book.difference(older, sampling);
    ASSERT_TRUE(difference.has_value());
    EXPECT_EQ(difference->name, "age_years");
    EXPECT_EQ(difference->here, "61");
    EXPECT_EQ(difference->in_book, "30");
    Eye other;
    other.anatomy.lashes.width_um = 80;
    EXPECT_EQ(book.difference(other, sampling)->name, "lashes.width_um");
    SpectralSampling lamp = sampling;
    lamp.illuminant = color::Illuminant::kSodium;
    EXPECT_EQ(book.difference(Eye(), lamp)->name, "source_spectrum");

    EXPECT_THROW(FlipbookPlayer(book, older, sampling, kRaster), InvalidArgument);
    wave::KernelGrid grid = kRaster;
    grid.pitch_deg *= 1.001;
    EXPECT_THROW(FlipbookPlayer(book, Eye(), sampling, grid), InvalidArgument);
    grid = kRaster;
    grid.projection = Projection::kConstantPitch;
    EXPECT_THROW(FlipbookPlayer(book, Eye(), sampling, grid), InvalidArgument);
}

TEST(Flipbook, RefusesWhatCannotBeBaked) {
    const EyePsfOptions options = small_options();
    const auto refused = [&](const Eye& eye, const wave::KernelGrid& raster,
                             const FlipbookRange& range) {
        EXPECT_THROW(bake_flipbook(eye, raster, range, options), InvalidArgument);
    };
    Eye clear;
    clear.scatter = ScatterModel::kNone;
    refused(clear, kRaster, small_range());
    wave::KernelGrid raster = kRaster;
    raster.width = 65;
    refused(Eye(), raster, small_range());
    raster.height = 65;  // 66 = 2 * 3 * 11
    refused(Eye(), raster, small_range());
    FlipbookRange range = small_range();
    range.lens_states = 2;
    refused(Eye(), kRaster, range);
    range = small_range();
    range.pupil_to_mm = 4;
    refused(Eye(), kRaster, range);
    range = small_range();
    range.largest_closure = 1;
    refused(Eye(), kRaster, range);
}

}  // namespace
}  // namespace aureole::eye
