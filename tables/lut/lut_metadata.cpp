#include "tables/lut/lut_metadata.hpp"

#include <array>

#include "schemas/documents/json_document.hpp"
#include "schemas/documents/schema_check.hpp"
#include "schemas/input_error.hpp"
#include "tables/files/hash.hpp"
#include "tables/lut/lut_values.hpp"
#include "tables/version.hpp"

namespace irido::tables {

namespace {

using nlohmann::json;

/// Keys derived from the table or the file's layout, not stored in the facts.
constexpr std::array kDerivedKeys{"kind", "axes", "channels", "dtype", "mips", "blocks", "stacked"};

constexpr const char* kMetadataChecksum = "metadata_checksum";

/// One line, keys sorted.
std::string dumped(const json& metadata) {
    return metadata.dump(-1, ' ', false, json::error_handler_t::replace);
}

LutAxis axis_from(const json& metadata) {
    LutAxis axis;
    axis.name = metadata["name"];
    axis.unit = metadata["unit"];
    const double first = metadata["first"], last = metadata["last"];
    const std::size_t count = metadata["count"];
    const bool has_values = metadata.contains("values");
    if (has_values != (metadata["mapping"] == "list"))
        throw LutError("metadata: axis " + axis.name +
                       " must have values exactly when its mapping is list");
    if (has_values)
        axis.values = metadata["values"].get<std::vector<double>>();
    else
        axis.values = equally_spaced(first, last, count);
    if (axis.count() != count || axis.values.front() != first || axis.values.back() != last)
        throw LutError("metadata: first, last and count of axis " + axis.name +
                       " do not match its values");
    return axis;
}

void check_metadata(const json& metadata) {
    static const schemas::Schema schema(json::parse(lut_schema_text()));
    const std::vector<schemas::Problem> problems = schemas::check(schema, metadata);
    if (problems.empty()) return;
    const schemas::Problem& first = problems.front();
    throw LutError("metadata: " + first.pointer + (first.pointer.empty() ? "" : ": ") +
                   first.message);
}

json parsed_metadata(std::string_view text) {
    json metadata;
    try {
        metadata = schemas::parse_json(text, "metadata");
    } catch (const schemas::InputError& error) {
        throw LutError("the metadata is damaged: " + error.where + ": " + error.message);
    }
    check_metadata(metadata);
    return metadata;
}

}  // namespace

const char* lut_schema_text() {
    return
#include "lut_schema.inc"
        ;
}

json axis_metadata(const LutAxis& axis) {
    json metadata{{"name", axis.name},
                  {"unit", axis.unit},
                  {"first", axis.values.front()},
                  {"last", axis.values.back()},
                  {"count", axis.count()},
                  {"mapping", axis.is_linear() ? "linear" : "list"}};
    if (!axis.is_linear()) metadata["values"] = axis.values;
    return metadata;
}

json metadata_of(const Lut& lut) {
    check_shape(lut);
    json metadata = lut.facts.is_object() ? lut.facts : json::object();
    const Build& build = this_build();
    if (metadata.emplace("irido", build.version).second && !build.commit.empty())
        metadata["commit"] = build.commit;
    metadata.emplace("error", nullptr);
    metadata.emplace("notes", json::array());
    metadata["kind"] = lut.kind;
    metadata["axes"] = json::array();
    for (const LutAxis& axis : lut.axes) metadata["axes"].push_back(axis_metadata(axis));
    metadata["channels"] = lut.channels;
    metadata["dtype"] = name_of(lut.type);
    if (lut.mips) metadata["mips"] = true;
    metadata["checksum"] = checksum_of(lut);
    metadata.erase(kMetadataChecksum);
    metadata[kMetadataChecksum] = "sha256:" + sha256_of(dumped(metadata));
    return metadata;
}

std::string metadata_text(const json& metadata) {
    std::string text = dumped(metadata);
    parsed_metadata(text);  // ensures that it can be read back
    return text;
}

std::string metadata_text(const Lut& lut) {
    return metadata_text(metadata_of(lut));
}

Lut lut_from_metadata(std::string_view text) {
    json metadata = parsed_metadata(text);
    Lut lut;
    lut.kind = metadata["kind"];
    for (const json& axis : metadata["axes"]) {
        LutAxis read = axis_from(axis);
        lut.axes.push_back(std::move(read));
    }
    lut.channels = metadata["channels"].get<std::vector<std::string>>();
    lut.mips = metadata.value("mips", false);
    lut.type = find_lut_type(metadata["dtype"].get<std::string>()).value();
    for (const char* key : kDerivedKeys) metadata.erase(key);
    lut.facts = std::move(metadata);
    try {
        check_shape(lut);
    } catch (const LutError& error) {
        throw LutError(std::string("metadata: ") + error.what());
    }
    return lut;
}

std::string checksum_of(const Lut& lut) {
    return "sha256:" + sha256_of(value_bytes(lut));
}

LutFile companion_of(const Lut& lut) {
    std::string text = metadata_text(lut) + "\n";
    return {".json", std::move(text)};
}

Lut lut_from_companion(std::string_view bytes) {
    if (bytes.empty())
        throw LutError("its companion file with the metadata, named with .json added, is missing");
    return lut_from_metadata(bytes);
}

void check_plain(const LutLayout& layout, std::string_view format) {
    if (layout.zstd)
        throw LutError(std::string(format) +
                       " does not support Zstandard compression; only ktx2 does");
    if (layout.layers)
        throw LutError(std::string(format) + " does not support array layers; only ktx2 does");
}

}  // namespace irido::tables
