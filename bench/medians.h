// Medians of runs in turns, so that the machine's other work hits all of them.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
#include <vector>

namespace aureole::bench {

inline double now_ms() {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double, std::milli>(now).count();
}

inline std::vector<double> medians_ms(const std::vector<std::function<void()>>& cases,
                                      int rounds = 5) {
    std::vector<std::vector<double>> times(cases.size());
    for (int round = 0; round <= rounds; ++round) {
        for (std::size_t i = 0; i < cases.size(); ++i) {
            const double start = now_ms();
            cases[i]();
            if (round > 0) times[i].push_back(now_ms() - start);  // the first one warms up
        }
    }
    std::vector<double> medians;
    for (auto& list : times) {
        std::nth_element(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(list.size() / 2),
                         list.end());
        medians.push_back(list[list.size() / 2]);
    }
    return medians;
}

}  // namespace aureole::bench
