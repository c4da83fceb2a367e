#include "ibl/running_sums.h"

#include <algorithm>
#include <cmath>

namespace aureole::ibl {
namespace {

// Of the table: what fits into the second level cache of a core, beside the rest.
constexpr int kTableBytes = 384 << 10;

}  // namespace

void RunningSums::integrate(const Outlines& outlines, double shift, const ConstImageView& rows,
                            int first_node, CellSum* cells) {
    if (outlines.points().empty()) return;
    double low = outlines.points().front().column;
    double high = low;
    int first_strip = outlines.points().front().strip;
    int end_strip = first_strip;
    for (const OutlinePoint& point : outlines.points()) {
        low = std::min(low, point.column);
        high = std::max(high, point.column);
        first_strip = std::min(first_strip, point.strip);
        end_strip = std::max(end_strip, point.strip + 1);
    }
    first_column_ = static_cast<int>(std::floor(low + shift));
    columns_ = static_cast<int>(std::floor(high + shift)) - first_column_ + 2;
    const int strips_at_once =
        std::max(1, kTableBytes / (columns_ * static_cast<int>(sizeof(Node))) - 1);
    for (int first = first_strip; first < end_strip; first += strips_at_once) {
        const int end = std::min(end_strip, first + strips_at_once);
        table_.resize(std::max(table_.size(), static_cast<std::size_t>(columns_) *
                                                  static_cast<std::size_t>(end - first + 1)));
        for (int node = first; node <= end; ++node) {
            build(rows, first_node, node,
                  table_.data() + static_cast<std::ptrdiff_t>(node - first) * columns_);
        }
        add_points(outlines, shift, first, end, cells);
    }
}

void RunningSums::build(const ConstImageView& rows, int first_node, int node, Node* out) const {
    const float* planes[3];
    for (int c = 0; c < 3; ++c) {
        planes[c] = rows.data + rows.offset(0, grid_.row(node) - first_node, c);
    }
    int x = first_column_ % grid_.width;
    if (x < 0) x += grid_.width;
    double sum[3] = {};
    float last[3] = {planes[0][x], planes[1][x], planes[2][x]};
    for (int i = 0; i < columns_; ++i) {
        for (int c = 0; c < 3; ++c) {
            const float value = planes[c][x];
            // Linear between pixels: the trapezium is exact.
            sum[c] += i == 0 ? 0.0 : 0.5 * (double{last[c]} + double{value});
            out[i].sum[c] = sum[c];
            out[i].value[c] = value;
            last[c] = value;
        }
        out[i].sum[3] = 0;
        out[i].value[3] = 0;
        if (++x == grid_.width) x = 0;
    }
}

void RunningSums::add_points(const Outlines& outlines, double shift, int first_strip, int end_strip,
                             CellSum* cells) const {
    const double origin = shift - first_column_;
    for (const OutlineRun& run : outlines.runs()) {
        double sum[4] = {};
        double area = 0;
        for (int k = run.first; k < run.end; ++k) {
            const OutlinePoint& point = outlines.points()[static_cast<std::size_t>(k)];
            if (point.strip < first_strip || point.strip >= end_strip) continue;
            const double column = point.column + origin;
            const int i = static_cast<int>(column);
            const double f = column - i;
            const double square = 0.5 * f * f;
            area += point.weight * column;
            const Node* node = table_.data() +
                               static_cast<std::ptrdiff_t>(point.strip - first_strip) * columns_ +
                               i;
            const double shares[2] = {point.weight * (1 - point.fraction),
                                      point.weight * point.fraction};
            for (const double share : shares) {
                const double here = share * (f - square);
                const double next = share * square;
                for (int c = 0; c < 4; ++c) {
                    sum[c] += share * node[0].sum[c] + here * double{node[0].value[c]} +
                              next * double{node[1].value[c]};
                }
                node += columns_;
            }
        }
        const auto add = [&](int index, double sign) {
            if (index < 0) return;
            CellSum& cell = cells[index];
            for (int c = 0; c < 3; ++c) cell.rgb[c] += sign * sum[c];
            cell.area += sign * area;
        };
        add(run.plus, 1);
        add(run.minus, -1);
    }
}

}  // namespace aureole::ibl
