// The lenses that come with Aureole.
#include "aureole/lens/library.h"

#include <gtest/gtest.h>

#include "aureole/base/error.h"
#include "aureole/lens/formats.h"

namespace aureole::lens {
namespace {

TEST(ShippedLenses, AllParse) {
    EXPECT_EQ(shipped_lenses().size(), 18u);
    for (const ShippedLens& shipped : shipped_lenses()) {
        SCOPED_TRACE(shipped.id);
        const Prescription lens = shipped_lens(shipped.id);
        EXPECT_EQ(parse_toml(to_toml(lens), "again"), lens);
    }
}

}  // namespace
}  // namespace aureole::lens
