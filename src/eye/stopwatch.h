// Time for the stages of EyePsfTimings.
#pragma once

#include <chrono>

namespace aureole::eye {

// Seconds of a steady clock; only differences mean anything.
inline double seconds() {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double>(now).count();
}

}  // namespace aureole::eye
