// A pass as a function in SSA form, and the names from its text.
//
// Names from the text for the instructions of a Function: assigned variables, and inlined calls. Filled if
// the text is compiled with Names::keep, else empty.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tidemark::proof {

/// A function's body, inlined for one call of it.
struct InlinedCall {
    std::string function{};
    int line = 0;        ///< of the call; 0: the entry point
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
        stored,  ///< into an array: `offset` selects the element
    } kind = Kind::computed;
    std::string name{};             ///< for example `p`, `hit.normal`, `lights[2].colour`
    std::vector<uint32_t> values{}; ///< the scalars, column by column
    uint32_t rows = 1;              ///< of a vector or a matrix
    int line = 0;
    uint32_t call = 0;
    uint32_t block = 0; ///< block of the assignment
    uint32_t place = 0; ///< index of the instruction that follows it
    /// For `stored`: the element is first_element + offset / stride. `offset` is a value; k_no_value means 0.
    uint32_t offset = ~uint32_t{0}, first_element = 0, stride = 1;
};

struct SourceNames {
    std::vector<InlinedCall> calls{};
    std::vector<Statement> statements{};   ///< in the order of instructions
    std::vector<Assignment> assignments{}; ///< in the order of blocks and places
};

// A pass as one function in static single assignment (SSA) form over scalars: vectors, matrices and structs
// are split into components, and all calls are inlined. Plain data; evaluate.hpp evaluates it.

enum class Scalar : uint8_t { real, signed_int, unsigned_int, boolean };

/// Index of the instruction that computes the value.
using Value = uint32_t;
inline constexpr Value k_no_value = ~Value{0};

/// Operation of an instruction on its operands a, b, c. If the type selects the operation (`add` of reals or
/// of whole numbers, `less` of signed or unsigned numbers), it is the type of operand a.
enum class Op : uint8_t {
    constant,  ///< immediate: the bits of the value
    undefined, ///< any value
    phi,       ///< one operand for each predecessor of the block
    load,      ///< of the access `immediate`; a: the offset in it, absent if it is fixed
    store,     ///< of a into the access `immediate`; b: the offset, as for `load`

    add,
    subtract,
    multiply,
    divide,
    modulo,    ///< x - y floor(x / y); for whole numbers the remainder with the sign of y
    remainder, ///< with the sign of x
    negate,
    square, ///< a * a
    absolute,
    sign,
    minimum,
    maximum,

    floor,
    ceil,
    truncate,
    round, ///< halves away from zero
    round_even,
    fract,
    whole_multiple, ///< b floor(a / b)
    nearest_rest,   ///< a - b round(a / b)
    sqrt,
    inverse_sqrt,
    sin,
    cos,
    tan,
    asin,
    acos,
    atan,
    atan2, ///< atan of a / b, by quadrant
    sinh,
    cosh,
    tanh,
    asinh,
    acosh,
    atanh,
    exp,
    exp2,
    log,
    log2,
    pow,
    mix,     ///< a (1 - c) + b c
    hermite, ///< a a (3 - 2 a)
    quintic, ///< a a a (a (6 a - 15) + 10)
    ldexp,   ///< a 2^b

    bit_and,
    bit_or,
    bit_xor,
    bit_not,
    shift_left,
    shift_right, ///< arithmetic shift for signed numbers
    bit_count,
    lowest_bit,
    highest_bit,
    reverse_bits,

    less,
    less_equal,
    equal,
    not_equal, ///< true for NaN
    is_nan,
    is_inf,
    logical_and,
    logical_or,
    logical_not,
    select,   ///< a ? b : c
    narrowed, ///< a; b is equal in real arithmetic (function_builder.hpp) and may have narrower bounds

    to_real, ///< from a whole number
    to_int,  ///< from a real number, rounded towards zero
    bits_as, ///< the same 32 bits as another type

    texel,        ///< component and form of a look-up: the `Lookup` of index `immediate`
    derivative_x, ///< of a, to the next pixel
    derivative_y,
};

/// Operands of an operation; missing ones are zeros.
template <class Number>
struct Operands {
    const Number& a;
    const Number& b;
    const Number& c;
};

struct Instruction {
    Op op = Op::undefined;
    Scalar type = Scalar::real;
    uint32_t immediate = 0;
    uint32_t first_operand = 0; ///< index into Function::operands
    uint32_t operand_count = 0;
    int line = 0; ///< in the text that was compiled; 0: none
};

/// A range of memory cells: an array that is indexed, a uniform, an input or the output.
struct Access {
    uint32_t first = 0; ///< cell
    uint32_t size = 1;  ///< offsets are clamped to it

    /// Returns the first and the last cell that an offset within these bounds may select.
    std::pair<uint32_t, uint32_t> cells(const std::pair<int64_t, int64_t>& offset) const {
        const auto inside = [this](int64_t at) {
            return first + uint32_t(std::clamp<int64_t>(at, 0, int64_t{size} - 1));
        };
        return {inside(offset.first), inside(offset.second)};
    }
};

/// A variable in memory.
struct Variable {
    enum class Kind { uniform, input, output, local } kind = Kind::local;
    std::string name{};
    uint32_t first = 0; ///< cell; scalars in the order of declaration
    uint32_t size = 0;
    Scalar type = Scalar::real;                 ///< type of its first scalar
    uint32_t columns = 1, rows = 1, length = 0; ///< of a matrix or vector; `length` of an array, 0: none
};

struct Lookup {
    enum class Form { sample, fetch, size, gather, query } form = Form::sample;
    std::string sampler{}; ///< name of the sampler uniform
    uint32_t component = 0;
    uint32_t coordinates = 2; ///< number of operands that are coordinates; a level or two gradients follow
    bool has_level = false;
    bool has_bias = false;
    bool has_gradients = false;
};

struct Block {
    enum class End { jump, branch, multiway, leave, discard } end = End::leave;
    uint32_t first = 0, last = 0; ///< instructions [first, last); phis come first
    std::vector<uint32_t> predecessors{};
    Value condition = k_no_value;       ///< of a branch: successor 0 if it holds, else 1
    std::vector<uint32_t> successors{}; ///< of a multiway jump: successor 0 if no case fits
    std::vector<uint32_t> cases{};      ///< case i leads to successor i + 1
    bool loop = false;                  ///< is the header of a loop
    uint32_t behind_loop = 0;           ///< of a header: the block at which the text continues after the loop
    int line = 0;                       ///< of the jump that ends the block
};

struct Function {
    std::vector<Instruction> instructions; ///< constants first, then block by block
    std::vector<Value> operands;
    std::vector<Block> blocks; ///< a block comes after its dominators; 0 is the entry
    std::vector<Access> accesses;
    std::vector<Variable> variables;
    std::vector<Lookup> lookups;
    std::vector<Scalar> cells; ///< memory; the type of each cell
    SourceNames names{};

    std::span<const Value> operands_of(const Instruction& instruction) const {
        return {operands.data() + instruction.first_operand, instruction.operand_count};
    }
    const Variable* find(std::string_view name) const {
        for (const Variable& variable : variables)
            if (variable.name == name)
                return &variable;
        return nullptr;
    }
};

} // namespace tidemark::proof
