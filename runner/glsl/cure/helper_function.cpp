#include "glsl/cure/helper_function.hpp"

#include <utility>

namespace tidemark::glsl {

void HelperFunction::use(NodeId expression, const Say& say) {
    const NodeId function = text_.tree().around(expression, NodeKind::function);
    const auto written = written_for(text_, expression, expression);
    if (function == k_no_node || !written)
        return;
    const Word& start = text_.words()[text_.tree()[function].begin];
    Wrap first = wrapped(text_, {start.spelled, start.spelled}, "", "");
    Wrap use = in_place_of(text_, *written, "");
    const std::string& file = use.first.where.file;
    if (start.from_macro() || first.first.where.file != file)
        return;
    const auto known = files_.find(file);
    const std::string name =
        known == files_.end() ? fresh_name(text_, wanted_, files_.size() + 1) : known->second.name;
    auto words = say(name);
    if (!words)
        return;
    use.front = *std::move(words);
    files_.try_emplace(file, Uses{name, std::move(first)}).first->second.wraps.push_back(std::move(use));
}

std::vector<Cure> HelperFunction::cures(const std::function<std::string(const std::string& name)>& define,
                                        const std::string& reason) const {
    std::vector<Cure> cures;
    for (const auto& [file, uses] : files_) {
        Cure& cure = cures.emplace_back(Cure{{uses.first}, reason});
        cure.wraps.front().front = define(uses.name);
        cure.wraps.insert(cure.wraps.end(), uses.wraps.begin(), uses.wraps.end());
    }
    return cures;
}

} // namespace tidemark::glsl
