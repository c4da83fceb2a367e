#include "aureole/eye/thesis_frames.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "aureole/eye/ranges.h"

namespace aureole::eye {
namespace {

TEST(ThesisFrames, PagesGoBackAndForthWithoutStandingStill) {
    EXPECT_EQ(thesis_ping_pong(0), 0);
    EXPECT_EQ(thesis_ping_pong(59), 59);
    EXPECT_EQ(thesis_ping_pong(60), 58);
    EXPECT_EQ(thesis_ping_pong(118), 0);
    for (std::int64_t step = -500; step < 500; ++step) {
        const int page = thesis_ping_pong(step);
        EXPECT_TRUE(page >= 0 && page < kThesisFrames) << step;
        EXPECT_EQ(page, thesis_ping_pong(step + 2 * (kThesisFrames - 1))) << step;
        EXPECT_EQ(page, thesis_ping_pong(-step)) << step;
        EXPECT_EQ(std::abs(thesis_ping_pong(step + 1) - page), 1) << step;
    }
}

TEST(ThesisFrames, GratingsAreFiveFramesBeforeThePupil) {
    for (std::int64_t frame = -300; frame < 300; ++frame) {
        EXPECT_EQ(thesis_frames(frame).gratings, thesis_frames(frame + 5).pupil) << frame;
    }
}

TEST(ThesisFrames, ParticlesLoopForward) {
    for (std::int64_t frame = -300; frame < 300; ++frame) {
        const int page = thesis_frames(frame).particles;
        EXPECT_EQ(thesis_frames(frame + 1).particles, (page + 1) % kThesisFrames) << frame;
    }
    EXPECT_EQ(thesis_frames(0).particles, 0);
}

TEST(ThesisFrames, LidsMoveAsThePupilDoesButSlower) {
    for (std::int64_t frame = -300; frame < 300; ++frame) {
        EXPECT_EQ(thesis_frames(2 * frame).lids, thesis_frames(frame).pupil) << frame;
        EXPECT_EQ(thesis_frames(2 * frame + 1).lids, thesis_frames(2 * frame).lids) << frame;
    }
}

TEST(ThesisFrames, TheWholeRepeats) {
    for (std::int64_t frame = -7000; frame < 7000; frame += 13) {
        EXPECT_EQ(thesis_frames(frame), thesis_frames(frame + kThesisRepeat)) << frame;
    }
}

TEST(ThesisFrames, AnyFrameAndAnyTimeHavePages) {
    constexpr std::int64_t kLast = std::numeric_limits<std::int64_t>::max();
    const ThesisFrames pages = thesis_frames(kLast);
    EXPECT_EQ(pages, thesis_frames(kLast - kThesisRepeat));
    EXPECT_EQ(pages.particles, kLast % kThesisFrames);
    EXPECT_EQ(thesis_frame_at(1e300), thesis_frame_at(kFarthestTimeS));
    EXPECT_EQ(thesis_frame_at(-1e300), thesis_frame_at(-kFarthestTimeS));
}

TEST(ThesisFrames, AFrameBeginsAtItsTime) {
    for (std::int64_t frame = -2000; frame < 20000; ++frame) {
        const double time_s = static_cast<double>(frame) / kThesisFramesPerSecond;
        EXPECT_EQ(thesis_frame_at(time_s), frame);
        EXPECT_EQ(thesis_frame_at(time_s + 0.99 / kThesisFramesPerSecond), frame);
    }
}

TEST(ThesisFrames, PagesHoldTheWholeRangeOfMotion) {
    EXPECT_NEAR(thesis_pupil_mm(0), 1.9, 1e-9);  // 4.9 - 3, eq. 2.14
    EXPECT_NEAR(thesis_pupil_mm(59), 7.9, 1e-9);
    EXPECT_NEAR(thesis_lid_closure(0), 0, 1e-12);
    EXPECT_NEAR(thesis_lid_closure(59), 1, 1e-12);
    for (int page = 0; page < kThesisFrames; ++page) {
        EXPECT_EQ(thesis_pupil_page(thesis_pupil_mm(page)), page);
        EXPECT_EQ(thesis_lid_page(thesis_lid_closure(page)), page);
        if (page == 0) continue;
        EXPECT_GT(thesis_pupil_mm(page), thesis_pupil_mm(page - 1));
        EXPECT_GT(thesis_lid_closure(page), thesis_lid_closure(page - 1));
        EXPECT_GT(thesis_lens_scale(page), thesis_lens_scale(page - 1));
    }
    EXPECT_EQ(thesis_pupil_page(0.1), 0);
    EXPECT_EQ(thesis_pupil_page(100), 59);
}

}  // namespace
}  // namespace aureole::eye
