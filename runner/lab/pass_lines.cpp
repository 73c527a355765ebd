#include "lab/pass_lines.hpp"

#include "base/encoding.hpp"
#include "proof/loops.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

namespace tidemark::lab {
namespace {

using proof::Assignment;
using proof::Function;
using proof::Op;

/// Returns a name for a value that has none, from the text of its line.
std::string name_of(std::string_view line) {
    for (const char* word : {"if", "while", "for", "else if", "} else if"})
        if (line.starts_with(word))
            return "condition";
    if (line.starts_with("return"))
        return "return";
    const size_t equals = line.find('=');
    if (equals == std::string_view::npos || equals == 0 || line.substr(equals).starts_with("=="))
        return "value";
    const size_t end = line.find_last_not_of(" +-*/%&|^", equals - 1);
    const std::string left(trimmed(line.substr(0, end == std::string_view::npos ? 0 : end + 1)));
    return left.empty() || left.find_first_of("(<>!?") != std::string::npos
               ? "value"
               : left.substr(left.find_last_of(" \t") + 1);
}

/// Returns which values are only intermediate results for another value of the same line and call.
std::vector<bool> intermediate_values(const Function& function) {
    std::vector<uint32_t> statement_of(function.instructions.size());
    const auto& statements = function.names.statements;
    for (uint32_t i = 0; i < statements.size(); ++i) {
        const size_t end = i + 1 < statements.size() ? statements[i + 1].first : statement_of.size();
        std::fill(statement_of.begin() + statements[i].first, statement_of.begin() + long(end), i);
    }
    const auto together = [&](const proof::Statement& a, const proof::Statement& b) {
        return a.line == b.line && a.call == b.call;
    };
    std::vector<bool> result(function.instructions.size());
    for (size_t i = 0; i < function.instructions.size() && !statements.empty(); ++i)
        for (const proof::Value operand : function.operands_of(function.instructions[i]))
            if (together(statements[statement_of[i]], statements[statement_of[operand]]))
                result[operand] = true;
    return result;
}

bool computes(Op op) {
    return op != Op::constant && op != Op::undefined && op != Op::phi && op != Op::load && op != Op::store;
}

/// Values that follow each other with the same operation form one vector.
bool belongs_to(const Function& function, const Assignment& vector, uint32_t value) {
    const proof::Instruction &last = function.instructions[vector.values.back()],
                             &next = function.instructions[value];
    return vector.values.size() < 4 && vector.values.back() + 1 == value && last.op == next.op &&
           last.type == next.type;
}

bool stands_before(const Assignment& a, const Assignment& b) {
    return a.block != b.block ? a.block < b.block : a.place < b.place;
}

} // namespace

PassLines::PassLines(const PassFunction& function, const scene::Scene& scene, const scene::Pass& pass)
    : function_(&function) {
    const Function& all = function.function();
    for (const proof::Statement& each : all.names.statements)
        add_line(each.line);
    for (const Assignment& each : all.names.assignments)
        add_line(each.line);
    read_texts(scene, pass);
    for (const Assignment& each : all.names.assignments)
        if (lines_.contains(each.line))
            assignments_.push_back(each);
    add_unnamed(all);
    std::ranges::stable_sort(assignments_, stands_before);
    for (uint32_t block = 0; block <= all.blocks.size(); ++block)
        first_in_block_.push_back(size_t(
            std::ranges::lower_bound(assignments_, block, {}, &Assignment::block) - assignments_.begin()));
}

void PassLines::add_line(int number) {
    if (lines_.contains(number))
        return;
    if (SourceLocation where = function_->locate(number); !where.file.empty())
        lines_[number].where = std::move(where);
}

void PassLines::read_texts(const scene::Scene& scene, const scene::Pass& pass) {
    std::map<std::pair<std::string, int>, std::string> texts;
    for (const text::MappedText* part : {&scene.common, &pass.text}) {
        std::string_view rest = part->text();
        for (int line = 1; !rest.empty(); ++line) {
            const SourceLocation where = part->lines().locate(line);
            texts.try_emplace({where.file, where.line}, trimmed(rest.substr(0, rest.find('\n'))));
            rest.remove_prefix(std::min(rest.size(), std::min(rest.find('\n'), rest.size() - 1) + 1));
        }
    }
    for (auto& [number, line] : lines_)
        line.text = texts[{line.where.file, line.where.line}];
}

void PassLines::add_unnamed(const Function& function) {
    std::set<std::pair<int, proof::Value>> named;
    for (const Assignment& each : assignments_)
        for (const proof::Value value : each.values)
            named.emplace(each.line, value);
    const std::vector<bool> intermediate = intermediate_values(function);
    const std::vector<uint32_t> block_of = proof::blocks_of_instructions(function);
    const auto& statements = function.names.statements;
    for (size_t i = 0; i < statements.size(); ++i) {
        const proof::Statement& here = statements[i];
        if (!lines_.contains(here.line))
            continue;
        const size_t end = i + 1 < statements.size() ? statements[i + 1].first : function.instructions.size();
        const size_t first = assignments_.size();
        for (uint32_t value = here.first; value < end; ++value) {
            if (intermediate[value] || !computes(function.instructions[value].op) ||
                named.contains({here.line, value}))
                continue;
            if (assignments_.size() > first && assignments_.back().block == block_of[value] &&
                belongs_to(function, assignments_.back(), value))
                assignments_.back().values.push_back(value);
            else
                assignments_.push_back({Assignment::Kind::computed,
                                        name_of(lines_[here.line].text),
                                        {value},
                                        1,
                                        here.line,
                                        here.call,
                                        block_of[value]});
            assignments_.back().rows = uint32_t(assignments_.back().values.size());
            assignments_.back().place = value + 1;
        }
    }
}

std::span<const Assignment> PassLines::in_block(uint32_t block) const {
    return std::span(assignments_)
        .subspan(first_in_block_[block], first_in_block_[block + 1] - first_in_block_[block]);
}

const AuthorLine* PassLines::find(int line) const {
    const auto found = lines_.find(line);
    return found == lines_.end() ? nullptr : &found->second;
}

/// Returns the file of mainImage, or of the pass's other entry point: the last function in the text.
std::string PassLines::main_file() const {
    return lines_.empty() ? "" : lines_.rbegin()->second.where.file;
}

Result<int> PassLines::compiled_line(const SourceLocation& asked) const {
    const std::string file = asked.file.empty() ? main_file() : asked.file;
    std::map<int, int> with_code; // from the author's lines of that file to compiled lines
    for (const Assignment& each : assignments_)
        if (const SourceLocation& where = lines_.at(each.line).where; where.file == file)
            with_code.emplace(where.line, each.line);
    if (const auto found = with_code.find(asked.line); found != with_code.end())
        return found->second;
    if (with_code.empty())
        return fail(ErrorCode::usage,
                    fmt::format("--line {}:{}: the pass has no code from that file; it has code from {}",
                                file, asked.line, main_file()));
    const auto above = with_code.lower_bound(asked.line);
    std::vector<int> nearest;
    if (above != with_code.begin())
        nearest.push_back(std::prev(above)->first);
    if (above != with_code.end())
        nearest.push_back(above->first);
    return fail(ErrorCode::usage,
                fmt::format("--line {}: that line of {} computes nothing; the nearest line that does: {}",
                            asked.line, file, fmt::join(nearest, ", ")));
}

} // namespace tidemark::lab
