#include "cli/sarif.hpp"

#include "base/uri.hpp"
#include "cli/version.hpp"
#include "text/utf16.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <vector>

namespace tidemark::cli {
namespace {

/// The name of a pass in a JSON project is `waves.json:Image`.
constexpr std::string_view k_project = ".json:";

/// Lines of a pass's text in a project are not lines of the file, so the region is omitted.
Json location_in_project(const SourceLocation& where, size_t project_end) {
    return {{"physicalLocation",
             {{"artifactLocation", {{"uri", uri_reference(where.file.substr(0, project_end))}}}}},
            {"logicalLocations",
             Json::array({{{"name", where.file.substr(project_end + 1)},
                           {"fullyQualifiedName", fmt::format("{}:{}", where.file, where.line)}}})}};
}

/// Converts a column from bytes to UTF-16 units.
size_t column_of(const Finding& finding, int column) {
    return finding.line.empty() ? size_t(column)
                                : 1 + text::utf16_length(finding.line.substr(0, size_t(column) - 1));
}

Json location_of(const Finding& finding) {
    const SourceLocation& where = finding.diagnostic.where;
    if (const size_t at = where.file.find(k_project); at != where.file.npos)
        return location_in_project(where, at + k_project.size() - 1);
    Json region = {{"startLine", std::max(where.line, 1)}};
    if (where.column > 0)
        region["startColumn"] = column_of(finding, where.column);
    if (finding.end_column > 0)
        region["endColumn"] = column_of(finding, finding.end_column);
    return {{"physicalLocation",
             {{"artifactLocation", {{"uri", uri_reference(where.file)}}}, {"region", std::move(region)}}}};
}

Json result_of(const Finding& finding, size_t rule) {
    Json result = {{"ruleId", finding.rule.id},
                   {"ruleIndex", rule},
                   {"level", to_string(finding.diagnostic.severity)},
                   {"message", {{"text", finding.diagnostic.message}}}};
    if (!finding.diagnostic.where.file.empty())
        result["locations"] = Json::array({location_of(finding)});
    return result;
}

} // namespace

Json sarif_log(std::span<const Finding> findings) {
    std::vector<Rule> rules;
    Json results = Json::array();
    for (const Finding& finding : findings) {
        const auto known = std::ranges::find(rules, finding.rule);
        results.push_back(result_of(finding, size_t(known - rules.begin())));
        if (known == rules.end())
            rules.push_back(finding.rule);
    }
    Json described = Json::array();
    for (const Rule& rule : rules)
        described.push_back({{"id", rule.id}, {"shortDescription", {{"text", rule.about}}}});
    return {
        {"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
        {"version", "2.1.0"},
        {"runs",
         Json::array({{{"tool",
                        {{"driver",
                          {{"name", "Tidemark"}, {"version", k_version}, {"rules", std::move(described)}}}}},
                       {"columnKind", "utf16CodeUnits"},
                       {"results", std::move(results)}}})}};
}

} // namespace tidemark::cli
