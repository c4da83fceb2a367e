#include <aureole/base/parallel.h>
#include <aureole/image/image.h>

#include <atomic>
#include <cstdio>

// A picture, filled by the library's own threads.
int main() {
    aureole::Image picture(64, 36, 3);
    std::atomic<int> rows = 0;
    aureole::parallel_for(36, [&](std::size_t y, int) {
        for (int x = 0; x < picture.width(); ++x) picture.at(x, static_cast<int>(y), 1) = 1;
        ++rows;
    });
    std::printf("%d rows, last value %g\n", rows.load(),
                static_cast<double>(picture.at(63, 35, 1)));
    return rows == 36 && picture.at(63, 35, 1) == 1 ? 0 : 1;
}
