// ShaderToy's JSON in all its dialects, and pages that hold it: read, or refused with words; every pass gets
// a name of its own.
#include "fuzz.hpp"
#include "scene/project.hpp"
#include "scene/project_exchange.hpp"

#include <set>

using namespace tidemark;

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    for (const char* id : {"", "abCD12"}) {
        const auto saved = scene::saved_project(std::string(text_of(data, size)), id, "x.html");
        REQUIRE(saved || !to_string(saved.error()).empty());
    }
    (void)scene::projects_in_page(text_of(data, size));
    for (const scene::CodeIn code : {scene::CodeIn::json, scene::CodeIn::files}) {
        const auto project = scene::read_project(text_of(data, size), "x.json", code);
        if (!project) {
            REQUIRE(!to_string(project.error()).empty());
            continue;
        }
        const std::vector<std::string> names = scene::pass_names(*project);
        REQUIRE(names.size() == project->passes.size());
        REQUIRE(std::set<std::string>(names.begin(), names.end()).size() == names.size());
        for (const scene::ProjectPass& pass : project->passes)
            for (const scene::ProjectInput& input : pass.inputs)
                REQUIRE(input.channel >= 0 && input.channel < 4);
    }
    return 0;
}
