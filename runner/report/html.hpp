// Pages out of forms, and texts that a scene, a study or a driver chose as words of a page: no character of
// theirs is markup.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace tidemark::report {

/// For content and for attributes in quotes, on one line: control characters are blanks.
std::string escaped(std::string_view text);

/// The same, with its line breaks.
std::string escaped_lines(std::string_view text);

/// JSON for a `<script>`, which ends at the first `</script`, whatever that is to JSON.
std::string in_script(std::string_view json);

struct Filling {
    std::string_view mark; ///< `{{title}}`
    std::string_view text; ///< HTML
};

/// Each mark of the form once, in their order; what is filled in is not looked at again.
std::string filled(std::string_view form, std::initializer_list<Filling> fillings);

} // namespace tidemark::report
