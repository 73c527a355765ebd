#include "lab/pixel/kept_values.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace tidemark::lab {
namespace {

constexpr size_t k_first = 4, k_last = 3;
/// Limit if iterations were requested.
constexpr size_t k_most = 1000;

} // namespace

bool TracedValue::finite() const {
    return std::ranges::all_of(in_float, [](double each) { return std::isfinite(each); });
}

bool TracedValue::mismatch() const {
    return kind != Kind::real && in_float != in_double;
}

void KeptValues::add(TracedValue value, const std::optional<TurnRange>& turns) {
    value.number = ++count_;
    if (turns) {
        const bool asked =
            !value.turns.empty() && value.turns.back() >= turns->first && value.turns.back() <= turns->second;
        if (asked && first_.size() < k_most)
            first_.push_back(std::move(value));
        return;
    }
    const auto note = [&](std::optional<TracedValue>& event, bool happens) {
        if (!event && happens)
            event = value;
    };
    note(not_finite_, !value.finite());
    note(mismatch_, value.mismatch());
    note(unstable_, value.unstable);
    if (!fewest_ || value.digits < fewest_->digits)
        fewest_ = value;
    if (first_.size() < k_first) {
        first_.push_back(std::move(value));
        return;
    }
    last_.push_back(std::move(value));
    if (last_.size() > k_last)
        last_.pop_front();
}

std::vector<TracedValue> KeptValues::all() const {
    std::map<uint64_t, TracedValue> by_number;
    for (const TracedValue& each : first_)
        by_number.emplace(each.number, each);
    for (const TracedValue& each : last_)
        by_number.emplace(each.number, each);
    for (const auto* event : {&not_finite_, &mismatch_, &unstable_, &fewest_})
        if (*event)
            by_number.emplace((*event)->number, **event);
    std::vector<TracedValue> result;
    for (auto& [number, value] : by_number)
        result.push_back(std::move(value));
    return result;
}

} // namespace tidemark::lab
