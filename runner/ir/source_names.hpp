// Names from the text for the instructions of a Function: assigned variables, and inlined calls. Filled if
// the text is compiled with Names::keep, else empty.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tidemark::ir {

/// A function's body, inlined for one call of it.
struct InlinedCall {
    std::string function{};
    int line = 0; ///< of the call; 0: the entry point
    uint32_t caller = 0; ///< index into SourceNames::calls; its own index: the entry point
};

/// The instructions of one line in one call: from `first` up to the next statement.
struct Statement {
    uint32_t first = 0; ///< instruction
    int line = 0;
    uint32_t call = 0;
};

/// An assignment to a variable, or to a part of it: a scalar, a vector or a matrix.
struct Assignment {
    enum class Kind {
        computed,
        carried, ///< from one iteration of a loop to the next, at its header
        stored, ///< into an array: `offset` selects the element
    } kind = Kind::computed;
    std::string name{}; ///< for example `p`, `hit.normal`, `lights[2].colour`
    std::vector<uint32_t> values{}; ///< the scalars, column by column
    uint32_t rows = 1; ///< of a vector or a matrix
    int line = 0;
    uint32_t call = 0;
    uint32_t block = 0; ///< block of the assignment
    uint32_t place = 0; ///< index of the instruction that follows it
    /// For `stored`: the element is first_element + offset / stride. `offset` is a value; k_no_value means 0.
    uint32_t offset = ~uint32_t{0}, first_element = 0, stride = 1;
};

struct SourceNames {
    std::vector<InlinedCall> calls{};
    std::vector<Statement> statements{}; ///< in the order of instructions
    std::vector<Assignment> assignments{}; ///< in the order of blocks and places
};

} // namespace tidemark::ir
