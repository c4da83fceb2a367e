#include "aureole/fourier/sizes.h"

#include <string>

#include "aureole/base/error.h"

namespace aureole::fourier {

bool is_smooth(int n) noexcept {
    if (n < 1) return false;
    for (const int prime : {2, 3, 5, 7}) {
        while (n % prime == 0) n /= prime;
    }
    return n == 1;
}

int next_smooth(int n) {
    if (n < 1 || n > kMaxTransformSize) {
        throw InvalidArgument("transform size", std::to_string(n),
                              "must be in [1, " + std::to_string(kMaxTransformSize) + "]");
    }
    while (!is_smooth(n)) ++n;
    return n;
}

}  // namespace aureole::fourier
