// A visitor with one function per type of a std::variant: std::visit(Overloaded{…}, variant).
#pragma once

namespace tidemark {

template <class... Functions>
struct Overloaded : Functions... {
    using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>; // clang 14 deduces none for aggregates

} // namespace tidemark
