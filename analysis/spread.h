// How a measure's values scatter.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace plumbline {

/// Of the values that there are; 0 where there is none. Quantiles are values that occur: the least that at least that
/// share of all doesn't exceed.
struct Spread {
  std::uint64_t count = 0;
  double median = 0, p99 = 0, worst = 0;
};

/// Values of one measure, which come to a Spread. A NaN is no value.
class Values {
 public:
  void add(double x) {
    if (!std::isnan(x)) list_.push_back(x);
  }
  Spread spread() {
    if (list_.empty()) return {};
    std::ranges::sort(list_);
    const auto quantile = [this](double share) {
      const auto below = static_cast<std::size_t>(std::ceil(share * static_cast<double>(list_.size())));
      return list_[std::max<std::size_t>(below, 1) - 1];
    };
    return {.count = list_.size(), .median = quantile(0.5), .p99 = quantile(0.99), .worst = list_.back()};
  }

 private:
  std::vector<double> list_;
};

}  // namespace plumbline
