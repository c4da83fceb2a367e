#include "aureole/io/sequence.h"

#include <fmt/format.h>

#include <charconv>
#include <set>

#include "aureole/base/error.h"

namespace aureole::io {
namespace {

constexpr std::size_t kMostFrames = 1000000;
constexpr int kMostDigits = 9;

class RangeParser {
  public:
    explicit RangeParser(std::string_view text) : text_(text) {}

    std::vector<int> parse() {
        std::vector<int> frames;
        std::set<int> seen;
        do {
            const int first = number();
            const int last = take('-') ? number() : first;
            const int step = take('x') ? number() : 1;
            if (last < first) fail("the last frame of a range must not be before its first");
            if (step < 1) fail("the step must be at least 1");
            for (long long frame = first; frame <= last; frame += step) {
                if (!seen.insert(static_cast<int>(frame)).second) continue;
                frames.push_back(static_cast<int>(frame));
                if (frames.size() > kMostFrames) fail("at most a million frames are allowed");
            }
        } while (take(','));
        if (at_ != text_.size()) {
            fail("expected frames such as 5, 1001-1240, 1-10x2 or 1-3,7; stopped at \"" +
                 std::string(text_.substr(at_)) + "\"");
        }
        return frames;
    }

  private:
    [[noreturn]] void fail(const std::string& allowed) const {
        throw InvalidArgument("frames", std::string(text_), allowed);
    }
    bool take(char wanted) {
        const bool found = at_ < text_.size() && text_[at_] == wanted;
        if (found) ++at_;
        return found;
    }
    int number() {
        int value = 0;
        const char* const begin = text_.data() + at_;
        const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
        if (error == std::errc::result_out_of_range) fail("a frame number is too large");
        if (error != std::errc()) {
            fail("expected a whole number" +
                 (at_ < text_.size() ? " at \"" + std::string(text_.substr(at_)) + "\""
                                     : std::string(" at the end")) +
                 ", as in 5, 1001-1240, 1-10x2 or 1-3,7");
        }
        at_ += static_cast<std::size_t>(end - begin);
        return value;
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

// A file name around the place of its number.
struct Pattern {
    std::string before;
    std::string after;
    bool has_number = false;
    int digits = 0;
};

[[noreturn]] void fail(std::string_view pattern, const std::string& allowed) {
    throw InvalidArgument("file name pattern", std::string(pattern), allowed);
}

// The field that starts at text[at] == '%': sets its digits and returns its length.
std::size_t percent_field(std::string_view pattern, std::string_view text, std::size_t at,
                          int& digits) {
    std::size_t end = at + 1;
    digits = 0;
    const bool zeros = end < text.size() && text[end] == '0';
    while (end < text.size() && text[end] >= '0' && text[end] <= '9') {
        digits = digits * 10 + (text[end++] - '0');
        if (digits > kMostDigits) fail(pattern, "a frame number has at most 9 digits");
    }
    // "%4d" would pad with blanks, which nobody wants in a file name.
    if (end >= text.size() || text[end] != 'd' || (digits > 0 && !zeros)) {
        fail(pattern, "after % only d, 04d (any number of digits) or another % is allowed");
    }
    return end + 1 - at;
}

Pattern parse_pattern(std::string_view pattern) {
    const std::size_t slash = pattern.rfind('/');
    const std::size_t start = slash == std::string_view::npos ? 0 : slash + 1;
    const std::string_view name = pattern.substr(start);
    Pattern result;
    result.before = pattern.substr(0, start);
    for (std::size_t at = 0; at < name.size();) {
        std::string& text = result.has_number ? result.after : result.before;
        const bool escaped = name.substr(at, 2) == "%%";
        if (escaped || (name[at] != '%' && name[at] != '#')) {
            text += name[at];
            at += escaped ? 2 : 1;
            continue;
        }
        if (result.has_number) fail(pattern, "must have one place for the frame number only");
        result.has_number = true;
        if (name[at] == '%') {
            at += percent_field(pattern, name, at, result.digits);
        } else {
            std::size_t end = at;
            while (end < name.size() && name[end] == '#') ++end;
            result.digits = static_cast<int>(end - at);
            if (result.digits > kMostDigits) fail(pattern, "a frame number has at most 9 digits");
            at = end;
        }
    }
    return result;
}

}  // namespace

std::vector<int> parse_frames(std::string_view text) { return RangeParser(text).parse(); }

bool has_frame_number(std::string_view pattern) { return parse_pattern(pattern).has_number; }

std::string frame_path(std::string_view pattern, int frame) {
    const Pattern parsed = parse_pattern(pattern);
    if (!parsed.has_number) return std::string(pattern);
    // As printf's %0*d: the sign counts as a digit.
    return parsed.before + fmt::format("{:0{}d}", frame, parsed.digits) + parsed.after;
}

std::vector<std::string> frame_paths(std::string_view pattern, const std::vector<int>& frames) {
    if (frames.size() > 1 && !has_frame_number(pattern)) {
        fail(pattern, "needs a place for the number of " + std::to_string(frames.size()) +
                          " frames, such as shot.%04d.exr or shot.####.exr");
    }
    std::vector<std::string> paths;
    paths.reserve(frames.size());
    for (const int frame : frames) paths.push_back(frame_path(pattern, frame));
    return paths;
}

}  // namespace aureole::io
