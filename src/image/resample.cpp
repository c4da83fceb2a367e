#include "aureole/image/resample.h"

#include <string>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"

namespace aureole {

Image area_average(const ConstImageView& picture, int factor) {
    if (factor < 1 || picture.width % factor != 0 || picture.height % factor != 0) {
        throw InvalidArgument("factor of an area average", std::to_string(factor),
                              "must divide " + std::to_string(picture.width) + " x " +
                                  std::to_string(picture.height) + " pixels");
    }
    Image mean(picture.width / factor, picture.height / factor, picture.channels);
    const double share = 1.0 / (static_cast<double>(factor) * factor);
    parallel_for(static_cast<std::size_t>(mean.height()), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        for (int c = 0; c < picture.channels; ++c) {
            float* out = mean.row(y, c);
            for (int x = 0; x < mean.width(); ++x) {
                double sum = 0;
                for (int j = 0; j < factor; ++j) {
                    for (int i = 0; i < factor; ++i) {
                        sum += static_cast<double>(picture.at(x * factor + i, y * factor + j, c));
                    }
                }
                out[x] = static_cast<float>(share * sum);
            }
        }
    });
    return mean;
}

}  // namespace aureole
