// The bars of flipbooks at full size: 512 x 512 for 1080p at 60 deg.
#include <gtest/gtest.h>

#include "aureole/eye/flipbook_bake.h"
#include "aureole/eye/flipbook_player.h"
#include "eye/flipbook_format.h"

namespace aureole::eye {
namespace {

wave::KernelGrid raster_1080p() {
    return wave::KernelGrid::square(View::from_fov(1920, 1080, 60, Projection::kPerspective), 511);
}

TEST(FlipbookSlow, WholeRangeFitsInto64Megabytes) {
    FlipbookText text;
    text.grid = raster_1080p();
    text.identity = identity_of(Eye(), {});
    EXPECT_LE(open_book(text).bytes.size(), 64'000'000U);
    EXPECT_EQ(frames_of(FlipbookRange()).size(), 148U);
}

TEST(FlipbookSlow, AtFramesWithinTwoPercentPerRing) {
    FlipbookRange range;
    range.texture_pupils = 2;
    range.vitreous_phases = 2;
    range.halo_pupils = 2;
    range.streak_pupils = 2;
    range.lid_states = 2;
    for (const ScatterModel scatter : {ScatterModel::kCie, ScatterModel::kIjspeert}) {
        Eye eye;
        eye.scatter = scatter;
        const std::vector<std::byte> bytes = bake_flipbook(eye, raster_1080p(), range);
        const Flipbook book(bytes);
        for (const FlipbookLids lids : {FlipbookLids::kOpen, FlipbookLids::kCovering}) {
            const FlipbookErrors errors = errors_at_frames(book, eye, {}, lids, 4);
            EXPECT_EQ(errors.poses, 4);
            EXPECT_EQ(errors.to_deg, 5);
            EXPECT_LT(errors.worst_ring, 0.02);
            EXPECT_LT(errors.texture, 0.01);
            EXPECT_LT(errors.halo, 0.01);
            EXPECT_LT(errors.streaks, 0.01);
            // What is off a frame is worse, so that the measurement sees something.
            EXPECT_GT(errors_between_frames(book, eye, {}, lids, 1).worst_ring, 0.05);
        }
    }
}

}  // namespace
}  // namespace aureole::eye
