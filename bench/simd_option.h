// --simd=ssse3|avx2|avx512 restricts our transforms to an instruction set, so that machines can be
// compared at equal terms.
#pragma once

#include <fmt/core.h>
#include <hwy/targets.h>

#include <cstdlib>
#include <string_view>

namespace aureole::bench {

// Takes the option out of argv.
inline void take_simd_option(int& argc, char** argv) {
    constexpr std::string_view kOption = "--simd=";
    int kept = 1;
    for (int i = 1; i < argc; ++i) {
        const std::string_view argument = argv[i];
        if (!argument.starts_with(kOption)) {
            argv[kept++] = argv[i];
            continue;
        }
        const std::string_view name = argument.substr(kOption.size());
        const std::int64_t target = name == "ssse3"    ? HWY_SSSE3
                                    : name == "avx2"   ? HWY_AVX2
                                    : name == "avx512" ? HWY_AVX3
                                                       : 0;
        if (target == 0 || (hwy::SupportedTargets() & target) == 0) {
            fmt::print(stderr, "--simd={}: not supported by this machine\n", name);
            std::exit(2);
        }
        hwy::SetSupportedTargetsForTest(target);
    }
    argc = kept;
}

}  // namespace aureole::bench
