// Fills HTML templates and escapes text from scenes, studies and drivers, so that none of it acts as markup.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace tidemark::report {

/// Escapes text for content and quoted attributes, on one line: control characters become spaces.
std::string escaped(std::string_view text);

/// Escapes text for content and keeps its line breaks.
std::string escaped_lines(std::string_view text);

/// Escapes JSON for a `<script>` element, which would end at any `</script`, even inside a JSON string.
std::string in_script(std::string_view json);

struct Filling {
    std::string_view mark; ///< `{{title}}`
    std::string_view text; ///< HTML
};

/// Replaces each mark of the template once. `fillings` must be in the order of the marks; filled-in text is
/// not searched again.
std::string filled(std::string_view form, std::initializer_list<Filling> fillings);

} // namespace tidemark::report
