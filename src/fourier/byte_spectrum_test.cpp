#include "aureole/fourier/byte_spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "aureole/base/random.h"

namespace aureole::fourier {
namespace {

constexpr int kRows = 150;  // two blocks and a part of one
constexpr int kColumns = 37;

std::vector<float> noise() {
    std::vector<float> values;
    Random random(1);
    for (int i = 0; i < kRows * kColumns; ++i) {
        // Columns of very different size.
        values.push_back(static_cast<float>(random.normal() * std::exp2((i % kColumns) / 2 - 12)));
    }
    return values;
}

std::vector<float> decoded(const std::vector<std::byte>& bytes, float factor, int first_row = 0,
                           int end_row = kRows) {
    std::vector<float> sum(static_cast<std::size_t>((end_row - first_row) * kColumns));
    add_spectrum(bytes.data(), kRows, kColumns, first_row, end_row, factor, sum.data());
    return sum;
}

std::vector<std::byte> room() {
    return std::vector<std::byte>(byte_spectrum_size(kRows, kColumns));
}

TEST(ByteSpectrum, RoundsEachColumnToItsOwnScale) {
    const std::vector<float> values = noise();
    std::vector<std::byte> bytes = room();
    const float scale = encode_spectrum(values, kColumns, bytes.data());
    EXPECT_TRUE(scales_are_finite(bytes.data(), kRows, kColumns));
    const std::vector<float> back = decoded(bytes, scale);
    for (int column = 0; column < kColumns; ++column) {
        double squares = 0;
        double errors = 0;
        for (int row = 0; row < kRows; ++row) {
            const auto i = static_cast<std::size_t>(row * kColumns + column);
            squares += std::pow(static_cast<double>(values[i]), 2);
            errors += std::pow(static_cast<double>(back[i] - values[i]), 2);
        }
        EXPECT_LT(std::sqrt(errors / squares), 0.009) << column;
        EXPECT_GT(std::sqrt(errors / squares), 0.003) << column;
    }
}

TEST(ByteSpectrum, RowsAreReadOneByOneAndAddUp) {
    std::vector<std::byte> bytes = room();
    const float scale = encode_spectrum(noise(), kColumns, bytes.data());
    const std::vector<float> all = decoded(bytes, scale);
    const std::vector<float> part = decoded(bytes, scale, 61, 131);
    for (std::size_t i = 0; i < part.size(); ++i) EXPECT_EQ(part[i], all[i + 61 * kColumns]);
    std::vector<float> sum = all;
    add_spectrum(bytes.data(), kRows, kColumns, 0, kRows, -0.5F * scale, sum.data());
    for (std::size_t i = 0; i < sum.size(); ++i) EXPECT_FLOAT_EQ(sum[i], 0.5F * all[i]);
}

TEST(ByteSpectrum, ZerosHaveTheScaleZero) {
    std::vector<std::byte> bytes = room();
    bytes.back() = std::byte{1};
    const std::vector<float> zeros(static_cast<std::size_t>(kRows * kColumns));
    EXPECT_EQ(encode_spectrum(zeros, kColumns, bytes.data()), 0.0F);
    EXPECT_EQ(bytes, room());
}

// Values that differ by any power of two have the same bytes.
TEST(ByteSpectrum, DoesNotDependOnTheLevel) {
    const std::vector<float> values = noise();
    std::vector<float> faint = values;
    for (float& value : faint) value *= 0x1p-60F;
    std::vector<std::byte> bytes = room();
    std::vector<std::byte> faint_bytes = room();
    const float scale = encode_spectrum(values, kColumns, bytes.data());
    EXPECT_EQ(encode_spectrum(faint, kColumns, faint_bytes.data()), scale * 0x1p-60F);
    EXPECT_EQ(bytes, faint_bytes);
}

}  // namespace
}  // namespace aureole::fourier
