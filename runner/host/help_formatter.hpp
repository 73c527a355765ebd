// Formats an option's value, its default and the options it needs or excludes for the help and the manual
// pages, the same with every version of CLI11 (2.1 writes `NAME=DEFAULT`, 2.4 `NAME [DEFAULT]`).
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace tidemark::cli {

class HelpFormatter : public CLI::Formatter {
public:
    std::string make_option_opts(const CLI::Option* option) const override;
};

} // namespace tidemark::cli
