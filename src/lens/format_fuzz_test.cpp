// Files spoilt at random: a table that passes validation, or a FileError that names the file.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "aureole/base/random.h"
#include "aureole/lens/library.h"
#include "lens/format_fixtures.h"
#include "lens/format_test_support.h"

namespace aureole::lens {
namespace {

constexpr std::array<std::string_view, 22> kTokens = {"nan",
                                                      "inf",
                                                      "-1",
                                                      "0",
                                                      "1e999",
                                                      "-1e-999",
                                                      "\"",
                                                      "'",
                                                      ";",
                                                      "&",
                                                      "=\n",
                                                      "STO ",
                                                      "S ",
                                                      "SI ",
                                                      "[[surface]]\n",
                                                      "SURF 3\n",
                                                      "GLAS F2 0 0\n",
                                                      "DIAM 0\n",
                                                      "\xFF\xFE",
                                                      "EPD 1\n",
                                                      "CIR 0.0\n",
                                                      "1.0000001"};

std::size_t below(Random& random, std::size_t count) { return random.next_bits() % count; }

// One to four cuts, insertions, copies and changed bytes.
std::string spoilt(std::string text, Random& random) {
    for (std::size_t edits = 1 + below(random, 4); edits > 0 && !text.empty(); --edits) {
        const std::size_t at = below(random, text.size());
        const std::size_t length = below(random, 1 + std::min<std::size_t>(text.size() - at, 40));
        switch (below(random, 6)) {
            case 0:
                text.erase(at, length);
                break;
            case 1:
                text.insert(at, kTokens[below(random, kTokens.size())]);
                break;
            case 2:
                text.insert(below(random, text.size()), text.substr(at, length));
                break;
            case 3:
                text[at] = static_cast<char>(random.next_bits());
                break;
            case 4: {
                // A digit changed: the file stays well formed, the lens does not.
                const std::size_t digit = text.find_first_of("0123456789", at);
                if (digit != std::string::npos)
                    text[digit] = static_cast<char>('0' + below(random, 10));
                break;
            }
            default: {
                const std::size_t word = text.find_first_of("0123456789", at);
                if (word == std::string::npos) break;
                const std::size_t end = text.find_first_not_of("0123456789.", word);
                text.replace(word, end == std::string::npos ? end : end - word,
                             kTokens[below(random, kTokens.size())]);
            }
        }
        if (below(random, 50) == 0) text.resize(below(random, text.size() + 1));
    }
    return text;
}

// How many of `rounds` spoilt copies were still lenses.
int survivors(Parser parse, std::string_view text, int rounds) {
    Random random(2);
    int accepted = 0;
    for (int i = 0; i < rounds; ++i) {
        const std::string bytes = spoilt(std::string(text), random);
        try {
            Prescription lens = parse(bytes, "spoilt.file");
            validate(lens);
            // What was read can be written and read again.
            lens.warnings.clear();
            EXPECT_EQ(parse_toml(to_toml(lens), "again"), lens) << bytes;
            ++accepted;
        } catch (const FileError& error) {
            EXPECT_EQ(error.file(), "spoilt.file") << error.what() << "\n" << bytes;
            EXPECT_EQ(std::string(error.what()).rfind("spoilt.file: ", 0), 0u);
        }
    }
    return accepted;
}

TEST(FormatFuzz, SpoiltFilesAreLensesOrFileErrors) {
    const std::pair<Parser, std::string_view> files[] = {{parse_toml, kTripletToml},
                                                         {parse_zmx, kTripletZmx},
                                                         {parse_pbrt, kTripletDat},
                                                         {parse_code_v, kTripletSeq},
                                                         {parse_toml, shipped_lenses()[5].toml}};
    for (const auto& [parse, text] : files) {
        const int rounds = 3000;
        const int accepted = survivors(parse, text, rounds);
        // The changes must be neither harmless nor all fatal, or nothing was tested.
        EXPECT_GT(accepted, rounds / 50);
        EXPECT_LT(accepted, rounds * 49 / 50);
    }
}

TEST(FormatFuzz, SpoiltFilesWithoutAperturesToo) {
    std::string zmx = with(kTripletZmx, "FNUM 5 0", "ENPD 1");
    for (std::size_t at = 0; (at = zmx.find("DIAM", at)) != std::string::npos;) zmx[at] = 'X';
    EXPECT_GT(survivors(parse_zmx, zmx, 3000), 60);
}

}  // namespace
}  // namespace aureole::lens
