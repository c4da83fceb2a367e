// How long work reports its progress and learns that it should stop.
#pragma once

#include <string_view>

namespace aureole {

// Passed by reference to long operations; the default does nothing. Implementations may be called
// from the thread that started the work only.
class Progress {
  public:
    virtual ~Progress() = default;
    // `fraction` in [0, 1] of the named stage is done.
    virtual void report(std::string_view /*stage*/, double /*fraction*/) {}
    // True asks the operation to throw Cancelled at its next safe point.
    virtual bool cancelled() const { return false; }
};

}  // namespace aureole
