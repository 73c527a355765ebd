// Who watches long work: told of its parts, asked whether it may go on.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace tidemark::lab {

/// Asked between two pieces of work; false: stop here.
using KeepGoing = std::function<bool()>;

struct Watch {
    std::function<void(const std::string& what, size_t total)> begin; ///< a part of so many pieces
    std::function<void()> advance;                                    ///< one piece is done
    KeepGoing keep_going;                                             ///< false: end with what there is
};

} // namespace tidemark::lab
