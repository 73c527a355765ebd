// What the instructions of a Function are in the text: the variables that get a value, and the calls that
// were inlined. Kept where a text is compiled with Names::keep, else empty.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tidemark::ir {

/// A function's body as it was inlined for one call of it.
struct InlinedCall {
    std::string function{};
    int line = 0;        ///< of the call; 0: the entry point
    uint32_t caller = 0; ///< in SourceNames::calls; its own index: the entry point
};

/// What one line computes in one call: the instructions from `first` on, up to the next statement.
struct Statement {
    uint32_t first = 0; ///< instruction
    int line = 0;
    uint32_t call = 0;
};

/// A variable, or a part of it, gets a value: a scalar, a vector or a matrix.
struct Assignment {
    enum class Kind {
        computed,
        carried, ///< from one turn of a loop to the next, at its head
        stored,  ///< into an array: `offset` tells which element
    } kind = Kind::computed;
    std::string name{};             ///< as in `p`, `hit.normal`, `lights[2].colour`
    std::vector<uint32_t> values{}; ///< its scalars, columns first
    uint32_t rows = 1;              ///< of a vector or a matrix
    int line = 0;
    uint32_t call = 0;
    uint32_t block = 0; ///< where it happens
    uint32_t place = 0; ///< before which instruction
    /// Of what is stored: the element is first_element + offset / stride, the offset a value, k_no_value: 0.
    uint32_t offset = ~uint32_t{0}, first_element = 0, stride = 1;
};

struct SourceNames {
    std::vector<InlinedCall> calls{};
    std::vector<Statement> statements{};   ///< in the order of instructions
    std::vector<Assignment> assignments{}; ///< in the order of blocks and places
};

} // namespace tidemark::ir
