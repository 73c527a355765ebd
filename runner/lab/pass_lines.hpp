// The lines of a pass's text that compute something, and the values computed there: variables by the names
// that the compiler kept, and unnamed values that no other operation on their line uses.
#pragma once

#include "base/error.hpp"
#include "lab/pass_function.hpp"
#include "lab/pixel_trace.hpp"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace tidemark::lab {

class PassLines {
public:
    PassLines(const PassFunction& function, const scene::Scene& scene, const scene::Pass& pass);

    /// Returns the assignments in a block, in order of execution.
    std::span<const proof::Assignment> in_block(uint32_t block) const;
    std::span<const proof::Assignment> assignments() const { return assignments_; }
    /// Takes a line of the compiled text; returns nullptr for lines that Tidemark added.
    const AuthorLine* find(int line) const;
    /// Returns the line of the compiled text. The error names the nearest lines that have code.
    Result<int> compiled_line(const SourceLocation& asked) const;

private:
    void add_line(int number);
    void read_texts(const scene::Scene& scene, const scene::Pass& pass);
    void add_unnamed(const proof::Function& function);
    std::string main_file() const;

    const PassFunction* function_;
    std::map<int, AuthorLine> lines_;
    std::vector<proof::Assignment> assignments_;
    std::vector<size_t> first_in_block_; ///< with an end entry after the last block
};

} // namespace tidemark::lab
