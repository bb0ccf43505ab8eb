#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <tuple>

#include "core/color/held_stack.hpp"
#include "core/colorimetry/difference.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/colorimetry/space.hpp"
#include "core/error.hpp"
#include "core/stack/index_table.hpp"
#include "schemas/documents/design_parts.hpp"
#include "schemas/documents/schema_check.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/measured_table.hpp"
#include "schemas/readers/number_list.hpp"
#include "schemas/readers/spectrum_csv.hpp"
#include "schemas/readers/text_file.hpp"

namespace irido::schemas {

namespace {

using nlohmann::json;
using Quantity = DesignQuantity;

constexpr std::array<std::pair<std::string_view, Quantity>, 18> kQuantities{
    {{"R", Quantity::R},
     {"T", Quantity::T},
     {"A", Quantity::A},
     {"psi_deg", Quantity::psi_deg},
     {"delta_deg", Quantity::delta_deg},
     {"delta_nebraska_deg", Quantity::delta_nebraska_deg},
     {"phase_r_deg", Quantity::phase_r_deg},
     {"phase_t_deg", Quantity::phase_t_deg},
     {"gd_r_fs", Quantity::gd_r_fs},
     {"gd_t_fs", Quantity::gd_t_fs},
     {"gdd_r_fs2", Quantity::gdd_r_fs2},
     {"gdd_t_fs2", Quantity::gdd_t_fs2},
     {"tod_r_fs3", Quantity::tod_r_fs3},
     {"tod_t_fs3", Quantity::tod_t_fs3},
     {"lab", Quantity::lab},
     {"xyz", Quantity::lab},
     {"hex", Quantity::lab},
     {"total_thickness_nm", Quantity::total_thickness_nm}}};

/// Reads one target of the document, which becomes several if its file has several angles.
class TargetReader {
public:
    TargetReader(const json& target, std::size_t number, const std::string& folder,
                 DesignTask& task)
        : json_(target),
          pointer_("/targets/" + std::to_string(number)),
          number_(number),
          folder_(folder),
          task_(task),
          name_(target["quantity"].get<std::string>()) {}

    void read() {
        DesignTarget target;
        target.quantity =
            std::ranges::find(kQuantities, name_, &decltype(kQuantities)::value_type::first)
                ->second;
        const std::string side = json_.value("side", "eq");
        target.side = side == "ge"   ? TargetSide::at_least
                      : side == "le" ? TargetSide::at_most
                                     : TargetSide::equal;
        read_polarizations(target);
        if (json_.contains("angles_deg") && json_.contains("angle_deg"))
            fail("", "may have either \"angles_deg\" or \"angle_deg\"");
        target.angle_deg = {0};
        for (const char* key : {"angles_deg", "angle_deg"})
            if (json_.contains(key)) target.angle_deg = list(key, 0, 89.999);
        if (json_.contains("sigma")) task_.has_sigma = true;
        if (target.quantity == Quantity::lab) return read_color(std::move(target));
        if (json_.contains("color")) fail("/color", "belongs to lab, xyz and hex");
        if (target.quantity == Quantity::total_thickness_nm) {
            for (const char* key : {"wavelengths_nm", "angles_deg", "angle_deg", "file"})
                if (json_.contains(key)) fail(std::string("/") + key, "does not belong to it");
            target.target = numbers("target", target, 0);
            return finish(std::move(target));
        }
        if (json_.contains("file")) return read_file(target);
        if (!json_.contains("wavelengths_nm")) fail("", "must have the key \"wavelengths_nm\"");
        target.wavelength_nm = list("wavelengths_nm", 1, 1e7);
        target.target = numbers("target", target, 0);
        finish(std::move(target));
    }

private:
    [[noreturn]] void fail(const std::string& where, const std::string& words) const {
        throw InputError(task_.file, pointer_ + where, words);
    }

    void read_polarizations(DesignTarget& target) const {
        const std::string letters = json_.value("polarization", "u");
        target.polarizations.clear();
        for (const char letter : letters)
            if (letter != ',')
                target.polarizations.push_back(letter == 's'   ? Light::s
                                               : letter == 'p' ? Light::p
                                                               : Light::unpolarized);
        const bool is_phase =
            target.quantity >= Quantity::phase_r_deg && target.quantity <= Quantity::tod_t_fs3;
        if (is_phase && std::ranges::find(target.polarizations, Light::unpolarized) !=
                            target.polarizations.end())
            fail("/polarization", "must be s or p: unpolarized light has no phase");
    }

    std::vector<double> list(const char* key, double lowest, double highest) const {
        const json& value = json_[key];
        std::vector<double> values;
        if (value.is_number()) {
            values = {value.get<double>()};
        } else if (value.is_array()) {
            values = value.get<std::vector<double>>();
        } else {
            try {
                values = read_number_list(value.get<std::string>());
            } catch (const InputError& error) {
                fail(std::string("/") + key, error.message);
            }
        }
        for (const double one : values)
            if (!(one >= lowest && one <= highest))
                fail(std::string("/") + key, "must be in [" + to_text(lowest) + ", " +
                                                 to_text(highest) + "] (got " + to_text(one) + ")");
        return values;
    }

    /// One number per entry.
    /// One whose square is a finite number.
    double number(const json& value, const std::string& where) const {
        constexpr double kLargest = 1e100;
        const auto result = value.get<double>();
        if (std::abs(result) <= kLargest) return result;
        fail(where, "must be in [-1e100, 1e100] (got " + short_text(value) + ")");
    }

    std::vector<double> numbers(const char* key, const DesignTarget& target,
                                double otherwise) const {
        const std::size_t count = entry_count(target);
        if (!json_.contains(key)) return std::vector<double>(count, otherwise);
        const json& value = json_[key];
        const std::string where = std::string("/") + key;
        if (value.is_number()) return std::vector<double>(count, number(value, where));
        if (!value.is_array()) fail(where, "must be a number or an array of numbers");
        std::vector<double> values;
        for (std::size_t i = 0; i < value.size(); ++i) {
            const std::string place = where + "/" + std::to_string(i);
            if (!value[i].is_number())
                fail(place, "must be a number (got " + short_text(value[i]) + ")");
            values.push_back(number(value[i], place));
        }
        if (values.size() == count) return values;
        const std::size_t period =
            target.quantity == Quantity::lab ? 0 : target.wavelength_nm.size();
        if (values.size() != period)
            fail(where, "must have one number for each of the " + std::to_string(count) +
                            " entries" +
                            (period == 0 || period == count
                                 ? std::string()
                                 : ", or of the " + std::to_string(period) + " wavelengths") +
                            " (got " + std::to_string(values.size()) + ")");
        std::vector<double> all;
        while (all.size() < count) all.insert(all.end(), values.begin(), values.end());
        return all;
    }

    void finish(DesignTarget target) {
        target.weight = numbers("weight", target, 1);
        if (target.sigma.empty()) target.sigma = numbers("sigma", target, 1);
        if (!target.wavelength_nm.empty()) require_indices(target);
        task_.problem.targets.push_back(std::move(target));
        task_.target_numbers.push_back(number_);
    }

    void require_indices(const DesignTarget& target) const {
        try {
            IndexTable(task_.problem.stack, target.wavelength_nm);
        } catch (const DomainError& error) {
            fail(json_.contains("file") ? "/file" : "/wavelengths_nm", error.what());
        }
    }

    void read_file(const DesignTarget& like) {
        const std::string path = json_["file"].get<std::string>();
        const std::string place = (std::filesystem::path(folder_) / path).string();
        const std::vector<MeasuredRows> all = read_measured_table(
            read_text(place, TextSource::regular_file), place, name_, json_.value("column", ""));
        for (const MeasuredRows& rows : all) {
            DesignTarget target = like;
            target.wavelength_nm = rows.wavelength_nm;
            if (rows.angle_deg) target.angle_deg = {*rows.angle_deg};
            if (rows.angle_deg && (json_.contains("angles_deg") || json_.contains("angle_deg")))
                fail("/angles_deg", "are those of the file's column of angles");
            if (target.angle_deg.size() * target.polarizations.size() > 1 &&
                !(target.angle_deg.size() == 1 && name_.find("_deg") != std::string::npos))
                fail("",
                     "a file's values belong to one polarization, and without a column of "
                     "angles to one angle");
            target.target = rows.value;
            target.sigma = rows.sigma;
            if (!rows.sigma.empty()) task_.has_sigma = true;
            finish(std::move(target));
        }
    }

    void read_color(DesignTarget target) {
        for (const char* key : {"wavelengths_nm", "file", "column"})
            if (json_.contains(key)) fail(std::string("/") + key, "does not belong to a colour");
        if (target.side != TargetSide::equal) fail("/side", "must be eq for a colour");
        read_light(target.light);
        const json& value = json_["target"];
        const bool is_one = value.is_string() || (value.is_array() && value[0].is_number());
        const std::size_t count = entry_count(target);
        if (!is_one && !value.is_array()) fail("/target", rule());
        if (!is_one && value.size() != count)
            fail("/target", "must have one colour for each of the " + std::to_string(count) +
                                " angles and polarizations (got " + std::to_string(value.size()) +
                                ")");
        for (std::size_t e = 0; e < count; ++e)
            target.lab.push_back(color(is_one ? value : value[e]));
        finish(std::move(target));
    }

    std::string rule() const {
        return name_ == "hex" ? "must be \"#rrggbb\" or an array of these"
                              : "must be three numbers or an array of these";
    }

    void read_light(TargetLight& light) const {
        const json color = json_.value("color", json::object());
        const std::string name = color.value("illuminant", "D65");
        light.observer_deg = static_cast<int>(color.value("observer", 2.0));
        light.side = color.value("side", "R") == "R" ? Side::reflected : Side::transmitted;
        const auto names = illuminant_names();
        if (std::ranges::find(names, name) != names.end()) {
            light.illuminant = illuminant(name);
        } else if (name.find_first_of("./") != std::string::npos) {
            const std::string place = (std::filesystem::path(folder_) / name).string();
            light.illuminant = read_spectrum_csv(read_text(place, TextSource::regular_file), place);
        } else {
            std::vector<std::string_view> known(names.begin(), names.end());
            known.emplace_back("a CSV file");
            fail("/color/illuminant", not_one_of(known, name));
        }
        try {
            held_stack(task_.problem.stack,
                       Sensitivity(observer(light.observer_deg), light.illuminant));
        } catch (const DomainError& error) {
            fail("", error.what());
        }
    }

    Triple color(const json& value) const {
        const DesignTarget none;
        const Triple white = white_of();
        try {
            if (name_ == "hex") {
                if (!value.is_string()) fail("/target", rule());
                const RgbSpace& srgb = rgb_space("srgb");
                const RgbTransform transform(srgb, white, Adaptation::bradford);
                return lab(transform.xyz_of(rgb_of_hex(srgb, value.get<std::string>())), white);
            }
        } catch (const DomainError& error) {
            fail("/target", error.what());
        }
        if (!value.is_array() || value.size() != 3 ||
            !std::ranges::all_of(value, [](const json& one) { return one.is_number(); }))
            fail("/target", rule() + " (got " + short_text(value) + ")");
        const Triple triple{value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
        return name_ == "lab" ? triple : lab(triple, white);
    }

    Triple white_of() const {
        TargetLight light;
        read_light(light);
        return Sensitivity(observer(light.observer_deg), light.illuminant).white();
    }

    const json& json_;
    std::string pointer_;
    std::size_t number_;
    const std::string& folder_;
    DesignTask& task_;
    std::string name_;
};

/// Notes pairs of targets that demand different values of the same thing.
void note_contradictions(DesignTask& task) {
    using Key = std::tuple<Quantity, double, Light, double>;
    std::map<Key, std::pair<std::size_t, double>> equal;
    for (std::size_t t = 0; t < task.problem.targets.size(); ++t) {
        const DesignTarget& target = task.problem.targets[t];
        if (target.side != TargetSide::equal || target.wavelength_nm.empty()) continue;
        const std::size_t count = target.wavelength_nm.size();
        for (std::size_t e = 0; e < target.target.size(); ++e) {
            const std::size_t lights = entry_count(target) / count / target.angle_deg.size();
            const Key key{target.quantity, target.angle_deg[e / count / lights],
                          target.polarizations[e / count % lights],
                          target.wavelength_nm[e % count]};
            const auto [known, is_new] =
                equal.try_emplace(key, task.target_numbers[t], target.target[e]);
            if (is_new || known->second.second == target.target[e]) continue;
            task.notes.push_back(
                "/targets/" + std::to_string(known->second.first) + " and /targets/" +
                std::to_string(task.target_numbers[t]) + " contradict each other at " +
                to_text(target.wavelength_nm[e % count]) + " nm: " + to_text(known->second.second) +
                " and " + to_text(target.target[e]));
            return;
        }
    }
}

/// Notes powers that were probably meant as percentages.
void note_percentages(DesignTask& task) {
    constexpr double kMostPower = 1.2;
    for (std::size_t t = 0; t < task.problem.targets.size(); ++t) {
        const DesignTarget& target = task.problem.targets[t];
        const bool is_power = target.quantity == Quantity::R || target.quantity == Quantity::T ||
                              target.quantity == Quantity::A;
        if (!is_power) continue;
        const auto large =
            std::ranges::find_if(target.target, [](double value) { return value > kMostPower; });
        if (large == target.target.end()) continue;
        task.notes.push_back("/targets/" + std::to_string(task.target_numbers[t]) +
                             ": R, T and A are fractions; the target is " + to_text(*large));
        return;
    }
}

}  // namespace

void read_targets(const json& targets, const std::string& folder, DesignTask& task) {
    for (std::size_t i = 0; i < targets.size(); ++i)
        TargetReader(targets[i], i, folder, task).read();
    const bool has_weight = std::ranges::any_of(task.problem.targets, [](const DesignTarget& t) {
        return std::ranges::any_of(t.weight, [](double weight) { return weight > 0; });
    });
    if (!has_weight) throw InputError(task.file, "/targets", "all weights are 0");
    note_contradictions(task);
    note_percentages(task);
}

}  // namespace irido::schemas
