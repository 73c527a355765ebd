// The lines of a pass's text that compute something, and what is computed there: variables by the names that
// the compiler kept; and values that have none, where nothing else on
// their line uses them.
#pragma once

#include "base/result.hpp"
#include "lab/march/pass_function.hpp"
#include "lab/pixel/traced_line.hpp"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace tidemark::lab {

class PassLines {
public:
    PassLines(const PassFunction& function, const scene::Scene& scene, const scene::Pass& pass);

    /// What gets a value in that block, in order of execution.
    std::span<const ir::Assignment> in_block(uint32_t block) const;
    std::span<const ir::Assignment> assignments() const { return assignments_; }
    /// By the line of the text that was compiled; nothing for lines of our own making.
    const AuthorLine* find(int line) const;
    /// The line of the text that was compiled. An error names the nearest lines that have code.
    Result<int> compiled_line(const SourceLocation& asked) const;

private:
    void add_line(int number);
    void read_texts(const scene::Scene& scene, const scene::Pass& pass);
    void add_unnamed(const ir::Function& function);
    std::string main_file() const;

    const PassFunction* function_;
    std::map<int, AuthorLine> lines_;
    std::vector<ir::Assignment> assignments_;
    std::vector<size_t> first_in_block_; ///< and one behind the last
};

} // namespace tidemark::lab
