// What a flipbook says of bytes that are not what was baked.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "aureole/base/crc32.h"
#include "aureole/base/error.h"
#include "aureole/eye/flipbook_bake.h"
#include "eye/flipbook_format.h"

namespace aureole::eye {
namespace {

using testing::HasSubstr;

const std::vector<std::byte>& book() {
    static const std::vector<std::byte> bytes = [] {
        FlipbookRange range;
        range.texture_pupils = 1;
        range.lens_states = 1;
        range.vitreous_phases = 2;
        range.halo_pupils = 1;
        range.streak_pupils = 1;
        range.lid_states = 1;
        EyePsfOptions options;
        range.pupil_from_mm = 5;
        options.aperture = {2048, 10};  // the halo needs 2 deg
        options.spectral.bands = 2;
        return bake_flipbook(Eye(), {63, 63, 0.15, Projection::kPerspective}, range, options);
    }();
    return bytes;
}

std::string refusal(std::span<const std::byte> bytes) {
    try {
        const Flipbook flipbook(bytes);
    } catch (const InvalidArgument& error) {
        return error.what();
    }
    return "accepted";
}

std::string refusal_after(std::size_t at, unsigned bits) {
    std::vector<std::byte> bytes = book();
    bytes[at] ^= static_cast<std::byte>(bits);
    return refusal(bytes);
}

FlipbookPreamble preamble() {
    FlipbookPreamble value;
    std::memcpy(&value, book().data(), sizeof value);
    return value;
}

// Another preamble or text, with a right checksum.
std::vector<std::byte> resealed(const FlipbookPreamble& value, const std::string& from = "",
                                const std::string& to = "") {
    std::vector<std::byte> bytes = book();
    std::memcpy(bytes.data(), &value, sizeof value);
    if (!from.empty()) {
        std::string head(reinterpret_cast<const char*>(bytes.data()), value.head_bytes);
        const std::size_t place = head.find(from);
        EXPECT_NE(place, std::string::npos);
        EXPECT_EQ(from.size(), to.size());
        std::memcpy(bytes.data() + place, to.data(), to.size());
    }
    const std::uint32_t crc = crc32(std::span<const std::byte>(bytes).first(value.head_bytes - 4));
    std::memcpy(bytes.data() + value.head_bytes - 4, &crc, 4);
    return bytes;
}

TEST(FlipbookDamage, WholeBooksAreAccepted) {
    EXPECT_EQ(refusal(book()), "accepted");
    EXPECT_EQ(refusal(resealed(preamble())), "accepted");
}

TEST(FlipbookDamage, EveryByteOfTheHeadCounts) {
    for (std::size_t at = 0; at < preamble().head_bytes; ++at) {
        for (const unsigned bits : {0x01U, 0x80U, 0xffU}) {
            EXPECT_NE(refusal_after(at, bits), "accepted") << at;
        }
    }
    EXPECT_THAT(refusal_after(sizeof(FlipbookPreamble) + 3, 1), HasSubstr("checksum of its head"));
}

TEST(FlipbookDamage, EveryFrameCountsAndIsNamed) {
    const std::size_t head = preamble().head_bytes;
    const std::size_t size = (book().size() - head) / 4;
    const char* const names[] = {"frame 0 of the texture", "frame 1 of the texture",
                                 "frame 0 of the halo", "frame 0 of the streaks"};
    for (std::size_t frame = 0; frame < 4; ++frame) {
        for (const std::size_t at : {std::size_t{0}, size / 3, size / 2 + 1, size - 1}) {
            for (const unsigned bits : {0x01U, 0x80U}) {
                EXPECT_THAT(refusal_after(head + frame * size + at, bits), HasSubstr(names[frame]));
            }
        }
    }
}

TEST(FlipbookDamage, LengthsAreNamed) {
    const std::vector<std::byte>& bytes = book();
    const std::span<const std::byte> all(bytes);
    for (const std::size_t length : {std::size_t{0}, std::size_t{7}, std::size_t{39}}) {
        EXPECT_THAT(refusal(all.first(length)), HasSubstr("is no flipbook")) << length;
    }
    for (const std::size_t length :
         {std::size_t{40}, std::size_t{64}, bytes.size() / 2, bytes.size() - 1}) {
        EXPECT_THAT(refusal(all.first(length)), HasSubstr("cut off")) << length;
    }
    std::vector<std::byte> longer = bytes;
    longer.push_back(std::byte{0});
    EXPECT_THAT(refusal(longer), HasSubstr("something was added"));
}

TEST(FlipbookDamage, ForeignNewerAndSwappedBooksAreToldApart) {
    std::vector<std::byte> picture(5000, std::byte{0x76});
    EXPECT_THAT(refusal(picture), HasSubstr("is no flipbook"));
    FlipbookPreamble value = preamble();
    value.version = 3;
    EXPECT_THAT(refusal(resealed(value)),
                testing::AllOf(HasSubstr("version 3"), HasSubstr("version 2"), HasSubstr("newer")));
    value.version = 1;
    EXPECT_THAT(refusal(resealed(value)),
                testing::AllOf(HasSubstr("version 1"), HasSubstr("version 2"), HasSubstr("again")));
    value = preamble();
    value.byte_order = 0x04030201;
    EXPECT_THAT(refusal(resealed(value)), HasSubstr("byte order"));
    std::vector<std::byte> shifted(book().size() + 8);
    std::copy(book().begin(), book().end(), shifted.begin() + 1);
    EXPECT_THAT(refusal(std::span<const std::byte>(shifted).subspan(1, book().size())),
                HasSubstr("multiple of 8"));
}

// Right checksums around nonsense.
TEST(FlipbookDamage, WhatTheHeadSaysIsChecked) {
    const auto refused = [](const std::string& from, const std::string& to) {
        return refusal(resealed(preamble(), from, to));
    };
    EXPECT_THAT(refused("transform_size 64", "transform_size 62"), HasSubstr("raster"));
    EXPECT_THAT(refused("transform_size 64", "transform_size -4"), HasSubstr("transform_size"));
    EXPECT_THAT(refused("transform_size 64", "transform_size 70"), HasSubstr("frames"));
    EXPECT_THAT(refused("pitch_deg 0.15", "pitch_deg 0x15"), HasSubstr("pitch_deg"));
    EXPECT_THAT(refused("pitch_deg 0.15", "pitch_deg 9999"), HasSubstr("pitch"));
    EXPECT_THAT(refused("projection perspective", "projection perspectivf"),
                HasSubstr("projection"));
    EXPECT_THAT(refused("vitreous_phases 2", "vitreous_phases 9"), HasSubstr("frames"));
    EXPECT_THAT(refused("vitreous_phases 2", "vitreous_phases 0"), HasSubstr("phases"));
    EXPECT_THAT(refused("pupil_to_mm", "pupil_zu_mm"), HasSubstr("pupil_to_mm is missing"));
    EXPECT_THAT(refused("eye.seed", "eie.seed"), HasSubstr("unknown"));
}

}  // namespace
}  // namespace aureole::eye
