#include "aureole/lens/ghost_settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "aureole/base/error.h"

namespace aureole::lens {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::vector<Bounces> kGhosts = {{2, 0}, {5, 0}, {5, 2}, {7, 2}};

void expect_same(const GhostSetting& a, const GhostSetting& b) {
    EXPECT_EQ(a.bounces, b.bounces);
    EXPECT_EQ(a.enabled, b.enabled);
    EXPECT_EQ(a.gain, b.gain);
    EXPECT_EQ(a.tint, b.tint);
}

TEST(GhostSettings, AreReadAsWritten) {
    const std::vector<GhostSetting> settings = {
        {{5, 2}, false, 0.1F, {1, 0.333333343F, 1e-9F}},
        {{2, 0}, true, 3e20F, {0, 0, 16777216}},
    };
    const std::string text = ghosts_to_toml("a \"lens\" \\ \n", kGhosts, settings);
    const std::vector<GhostSetting> back = ghosts_from_toml(text, "g.toml", kGhosts);
    ASSERT_EQ(back.size(), kGhosts.size());
    expect_same(back[0], settings[1]);
    expect_same(back[1], GhostSetting{kGhosts[1]});
    expect_same(back[2], settings[0]);
    expect_same(back[3], GhostSetting{kGhosts[3]});
}

TEST(GhostSettings, DefaultsAndTheOrderOfSurfaces) {
    const auto settings =
        ghosts_from_toml("[[ghost]]\nsurfaces = [6, 3]\n[[ghost]]\nsurfaces = [1, 3]\ngain = 2\n",
                         "g.toml", kGhosts);
    ASSERT_EQ(settings.size(), 2U);
    expect_same(settings[0], GhostSetting{{5, 2}});
    expect_same(settings[1], GhostSetting{{2, 0}, true, 2});
    EXPECT_TRUE(ghosts_from_toml("", "g.toml", kGhosts).empty());
    EXPECT_TRUE(ghosts_from_toml("lens = \"any\"\nghost = []\n", "g.toml", kGhosts).empty());
}

// The strongest first, with what became of it above it.
TEST(GhostSettings, TellWhatBecameOfTheGhosts) {
    FlareReport report;
    GhostReport weak;
    weak.bounces = {5, 0};
    weak.drawn = GhostReport::Drawn::kDropped;
    weak.energy = 1;
    GhostReport strong;
    strong.bounces = {7, 2};
    strong.drawn = GhostReport::Drawn::kTraced;
    strong.energy = 3;
    strong.center_x = 812.34;
    strong.radius_px = 41.5;
    report.ghosts = {weak, strong};
    const std::string text = ghosts_to_toml("", kGhosts, {}, &report);
    const std::size_t first = text.find(
        "75 % of the energy, at (812.3, 0.0) px, radius 41.5 px, "
        "drawn by rays\nsurfaces = [3, 8]");
    const std::size_t second = text.find("25 % of the energy");
    const std::size_t third = text.find("surfaces = [1, 3]");
    ASSERT_NE(first, std::string::npos) << text;
    EXPECT_LT(first, second);
    EXPECT_LT(second, third);
    EXPECT_EQ(ghosts_from_toml(text, "g.toml", kGhosts).size(), kGhosts.size());
}

struct Wrong {
    std::string text;
    std::vector<std::string> message;
};
std::ostream& operator<<(std::ostream& stream, const Wrong& wrong) { return stream << wrong.text; }

class WrongGhostSettings : public testing::TestWithParam<Wrong> {};

TEST_P(WrongGhostSettings, NameFileLineEntryAndWhatIsAllowed) {
    try {
        ghosts_from_toml(GetParam().text, "g.toml", kGhosts);
        FAIL() << "was accepted";
    } catch (const FileError& error) {
        EXPECT_EQ(error.file(), "g.toml");
        for (const std::string& word : GetParam().message) {
            EXPECT_THAT(error.what(), HasSubstr(word));
        }
    }
}

const std::string kGood = "[[ghost]]\nsurfaces = [3, 6]\n";

INSTANTIATE_TEST_SUITE_P(
    All, WrongGhostSettings,
    testing::Values(
        Wrong{"[[ghost", {"line 1", "TOML"}}, Wrong{"colour = 1", {"colour", "lens", "ghost"}},
        Wrong{"ghost = 3", {"line 1", "[[ghost]]"}},
        Wrong{"[ghost]\nsurfaces = [3, 6]", {"[[ghost]]"}},
        Wrong{"[[ghost]]\ngain = 1", {"ghost 1", "surfaces"}},
        Wrong{"[[ghost]]\nsurfaces = 3", {"surfaces = 3", "two"}},
        Wrong{"[[ghost]]\nsurfaces = [3]", {"surfaces = [ 3 ]", "two"}},
        Wrong{"[[ghost]]\nsurfaces = [3, 3]", {"surfaces = [ 3, 3 ]", "different"}},
        Wrong{"[[ghost]]\nsurfaces = [0, 3]", {"line 2", "surfaces = [ 0, 3 ]"}},
        Wrong{"[[ghost]]\nsurfaces = [3, 4294967302]", {"line 2", "surfaces"}},
        Wrong{"[[ghost]]\nsurfaces = [3, 5]", {"surfaces = [3, 5]", "no such ghost", "4"}},
        Wrong{kGood + kGood, {"line 3", "ghost 2", "[3, 6]", "twice"}},
        Wrong{kGood + "gian = 2", {"line 3", "gian", "gain"}},
        Wrong{kGood + "enabled = 1", {"line 3", "ghost 1", "enabled = 1", "true or false"}},
        Wrong{kGood + "gain = -1", {"line 3", "ghost 1", "gain = -1", "at least 0"}},
        Wrong{kGood + "gain = nan", {"gain = nan", "at least 0"}},
        Wrong{kGood + "gain = 1e300", {"gain"}}, Wrong{kGood + "gain = \"2\"", {"gain"}},
        Wrong{kGood + "tint = [1, 1]", {"tint", "three"}},
        Wrong{kGood + "tint = [1, 1, -1]", {"tint = [ 1, 1, -1 ]", "at least 0"}},
        Wrong{kGood + "tint = [1, 1, \"red\"]", {"tint", "three numbers"}},
        Wrong{kGood + "tint = 2", {"tint = 2", "three"}}));

}  // namespace
}  // namespace aureole::lens
