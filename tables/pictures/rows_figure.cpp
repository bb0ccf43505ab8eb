#include "tables/pictures/rows_figure.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "core/keep_once.hpp"

namespace irido::tables {

namespace {

constexpr std::size_t kMostCurves = 9;       ///< over a number, if the others can be drawn along y
constexpr std::size_t kMostCategories = 24;  ///< curves, or strips of colour
constexpr std::size_t kMostPanels = 12;
constexpr std::size_t kMostGridCells = 20'000'000;

const Column& column_named(const Records& records, const std::string& name) {
    const auto found = std::ranges::find(records.columns, name, &Column::name);
    if (found == records.columns.end()) throw PictureError("there is no column " + name);
    return *found;
}

/// A key with its distinct values, in order of size or of appearance, and the one of each row.
struct VariedKey {
    const RowKey* key = nullptr;
    bool is_number = true;
    std::vector<double> numbers = {};
    std::vector<std::string> texts = {};
    std::vector<std::uint32_t> of_row = {};

    std::size_t size() const { return is_number ? numbers.size() : texts.size(); }
    std::string name(std::size_t value) const {
        if (!is_number) return texts[value];
        std::string number;
        append_number(number, numbers[value]);
        const std::string& unit = key->axis.unit;
        const std::string text = number + (unit.empty() || unit == "\u00b0" ? unit : " " + unit);
        // an angle or a wavelength needs no name
        return unit == "\u00b0" || key->axis.hues ? text : key->axis.quantity + " " + text;
    }
};

VariedKey varied_key(const Records& records, const RowKey& key) {
    VariedKey result{.key = &key};
    const Column& column = column_named(records, key.column);
    result.is_number = std::holds_alternative<Column::Numbers>(column.values) ||
                       std::holds_alternative<Column::CodedNumbers>(column.values);
    const std::size_t rows = records.rows();
    result.of_row.resize(rows);
    if (result.is_number) {
        const std::vector<double> numbers = column_numbers(records, key.column);
        result.numbers = numbers;
        keep_once(result.numbers);
        for (std::size_t i = 0; i < rows; ++i)
            result.of_row[i] = static_cast<std::uint32_t>(
                std::ranges::lower_bound(result.numbers, numbers[i]) - result.numbers.begin());
        return result;
    }
    const std::vector<std::string> texts = column_texts(records, key.column);
    std::map<std::string, std::uint32_t> known;
    for (std::size_t i = 0; i < rows; ++i) {
        const auto next = static_cast<std::uint32_t>(known.size());
        const auto [found, is_new] = known.try_emplace(texts[i], next);
        if (is_new) result.texts.push_back(texts[i]);
        result.of_row[i] = found->second;
    }
    return result;
}

/// Combinations of the values of some keys that occur, in order of appearance.
struct Combinations {
    std::vector<std::string> names;
    std::vector<std::size_t> of_row;
};

Combinations combinations_of(const std::vector<const VariedKey*>& keys, std::size_t rows) {
    Combinations result;
    result.of_row.resize(rows);
    std::map<std::vector<std::uint32_t>, std::size_t> known;
    std::vector<std::uint32_t> values(keys.size());
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t k = 0; k < keys.size(); ++k) values[k] = keys[k]->of_row[row];
        const auto [found, is_new] = known.try_emplace(values, known.size());
        result.of_row[row] = found->second;
        if (!is_new) continue;
        std::string name;
        for (std::size_t k = keys.size(); k-- > 0;)  // letters before numbers
            name += (name.empty() ? "" : ", ") + keys[k]->name(values[k]);
        result.names.push_back(std::move(name));
        if (result.names.size() > kMostGridCells) break;
    }
    return result;
}

/// Chooses which keys become axes.
class RowsFigure {
public:
    RowsFigure(const Records& records, const RowPlot& plot) : records_(records), plot_(plot) {
        if (records.rows() == 0) throw PictureError("there are no rows to draw");
        for (const RowKey& key : plot.keys) keys_.push_back(varied_key(records, key));
        figure_.title = plot.title;
        figure_.notes = plot.notes;
        std::string constant;
        for (const VariedKey& key : keys_) {
            if (key.size() > 1)
                (key.is_number ? numbers_ : categories_).push_back(&key);
            else
                constant += (constant.empty() ? "" : ", ") + said(key);
        }
        figure_.subtitle = constant;
    }

    Figure make() {
        if (numbers_.empty() && plot_.form == Series::Form::points && !categories_.empty()) {
            make_ladder();
            return std::move(figure_);
        }
        if (numbers_.empty()) {  // one position on the first available axis
            for (const VariedKey& key : keys_)
                if (key.is_number && numbers_.empty()) numbers_.push_back(&key);
            if (numbers_.empty()) throw PictureError("no column varies that could be an axis");
        }
        const bool has_colors = !plot_.inks.empty();
        const std::size_t most = has_colors ? 1 : kMostCurves;
        std::size_t others = 1;  // curves per category
        for (const VariedKey* key : numbers_) others *= key->size();
        others /= longest()->size();
        const bool is_map = numbers_.size() > 1 &&
                            (others > most || others * count_of(categories_) > kMostCategories);
        is_map ? make_maps() : has_colors ? make_strips() : make_curves();
        return std::move(figure_);
    }

private:
    static std::string said(const VariedKey& key) {
        const std::string name = key.name(0);
        if (name.starts_with(key.key->axis.quantity)) return name;
        return key.key->axis.quantity.empty() ? name : key.key->axis.quantity + " " + name;
    }
    static std::size_t count_of(const std::vector<const VariedKey*>& keys) {
        return std::accumulate(keys.begin(), keys.end(), std::size_t{1},
                               [](std::size_t n, const auto* key) { return n * key->size(); });
    }
    const VariedKey* longest() const { return *std::ranges::max_element(numbers_, {}, &size_of); }
    static std::size_t size_of(const VariedKey* key) { return key->size(); }

    /// Combinations of the keys that are not axes.
    Combinations others_than(std::vector<const VariedKey*> axes, std::size_t most,
                             const std::string& what) const {
        std::vector<const VariedKey*> rest = numbers_;
        rest.insert(rest.end(), categories_.begin(), categories_.end());
        std::erase_if(rest, [&](const auto* key) { return std::ranges::count(axes, key) > 0; });
        Combinations all = combinations_of(rest, records_.rows());
        if (all.names.size() > most)
            throw PictureError(
                "too much varies for one picture: " + std::to_string(all.names.size()) + " " +
                what + ", at most " + std::to_string(most));
        return all;
    }

    /// The values of each panel; values that are 0 throughout are left out.
    std::vector<std::vector<const RowValue*>> panels_of_values() {
        std::vector<std::vector<const RowValue*>> panels;
        std::vector<std::string> zeros;
        for (const RowValue& value : plot_.values) {
            const std::vector<double> numbers = column_numbers(records_, value.column);
            if (std::ranges::all_of(numbers, [](double x) { return x == 0; })) {
                zeros.push_back(value.column);
                if (zeros.size() < plot_.values.size()) continue;
                zeros.pop_back();
            }
            const auto same = std::ranges::find_if(panels, [&](const auto& panel) {
                return !value.panel.empty() && panel.front()->panel == value.panel;
            });
            if (same != panels.end())
                same->push_back(&value);
            else
                panels.push_back({&value});
        }
        if (panels.size() > kMostPanels)
            throw PictureError(
                "too many columns for one picture: " + std::to_string(panels.size()) +
                ", at most " + std::to_string(kMostPanels));
        if (!zeros.empty()) {
            std::string names;
            for (const std::string& name : zeros) names += (names.empty() ? "" : ", ") + name;
            figure_.notes.push_back(names + (zeros.size() == 1 ? " is" : " are") + " 0 throughout");
        }
        return panels;
    }

    void make_curves() {
        const VariedKey* x = longest();
        draw_along(column_numbers(records_, x->key->column), x->key->axis, x);
    }

    /// Points over the names of a category.
    void make_ladder() {
        const VariedKey* x = categories_.back();
        const std::vector<double> along(x->of_row.begin(), x->of_row.end());
        FigureAxis axis = x->key->axis;
        axis.names = x->texts;
        axis.first = -0.5;
        axis.last = static_cast<double>(x->size()) - 0.5;
        draw_along(along, axis, x);
    }

    /// Curves of all values over one coordinate per row, that of the key x.
    void draw_along(const std::vector<double>& along, const FigureAxis& axis, const VariedKey* x) {
        std::vector<const VariedKey*> paneled;
        for (const VariedKey* key : categories_)
            if (key->key->has_panels && key != x) paneled.push_back(key);
        const Combinations panels = combinations_of(paneled, records_.rows());
        std::vector<const VariedKey*> named = paneled;
        named.push_back(x);
        const Combinations others = others_than(named, kMostCategories, "curves");
        std::map<std::string, std::size_t> styles;
        for (const auto& values : panels_of_values()) {
            for (std::size_t p = 0; p < panels.names.size(); ++p) {
                Panel panel{panels.names[p], axis, values.front()->axis};
                if (values.size() > 1 && !values.front()->panel.empty())
                    panel.y.quantity = values.front()->panel;
                for (const RowValue* value : values)
                    add_curves(panel, *value, values.size() > 1, along, panels, p, others, styles);
                figure_.panels.push_back(std::move(panel));
            }
        }
        figure_.columns = panels.names.size() > 1 ? 2 : 1;
        figure_.shared_x = figure_.columns == 1;
        if (figure_.columns > 1) {
            figure_.width = 960;
            figure_.panel_height = 330;
        }
        if (styles.size() == 1 && !styles.begin()->first.empty()) drop_lone_name();
    }

    void add_curves(Panel& panel, const RowValue& value, bool has_name,
                    const std::vector<double>& along, const Combinations& panels, std::size_t p,
                    const Combinations& others, std::map<std::string, std::size_t>& styles) const {
        const std::vector<double> numbers = column_numbers(records_, value.column);
        std::vector<Series> all(others.names.size());
        for (std::size_t row = 0; row < along.size(); ++row)
            if (panels.of_row[row] == p && !std::isnan(numbers[row]))
                all[others.of_row[row]].points.push_back({along[row], numbers[row]});
        for (std::size_t i = 0; i < all.size(); ++i) {
            Series& series = all[i];
            if (series.points.empty()) continue;
            series.name = others.names[i];
            if (has_name) series.name += (series.name.empty() ? "" : ", ") + value.axis.quantity;
            series.style = styles.try_emplace(series.name, styles.size()).first->second;
            series.form = plot_.form;
            if (plot_.form == Series::Form::line)
                std::ranges::stable_sort(series.points, {}, &Point::x);
            panel.series.push_back(std::move(series));
        }
    }

    /// Removes a name that is the only one, as it distinguishes nothing.
    void drop_lone_name() {
        for (Panel& panel : figure_.panels)
            for (Series& series : panel.series) series.name.clear();
    }

    /// The cell of a row in a grid of two keys.
    static std::size_t cell(const VariedKey* x, const VariedKey* y, std::size_t row) {
        return y->of_row[row] * x->size() + x->of_row[row];
    }

    void make_maps() {
        std::vector<const VariedKey*> axes = numbers_;
        std::ranges::stable_sort(axes, std::ranges::greater(), &size_of);
        axes.resize(2);
        const VariedKey* x = axes[0];
        const VariedKey* y = axes[1];
        if (std::ranges::find(numbers_, y) < std::ranges::find(numbers_, x)) std::swap(x, y);
        if (x->size() * y->size() > kMostGridCells)
            throw PictureError("too many places in the plane: " + std::to_string(x->size()) +
                               " times " + std::to_string(y->size()));
        const Combinations others = others_than({x, y}, kMostPanels, "maps");
        const SampleGrid empty{x->numbers, y->numbers, {}, {}};
        const std::size_t cells = x->size() * y->size();
        if (!plot_.inks.empty()) {
            std::vector<SampleGrid> grids(others.names.size(), empty);
            for (SampleGrid& grid : grids) grid.inks.assign(cells, ink(0xffffff));
            for (std::size_t row = 0; row < plot_.inks.size(); ++row)
                grids[others.of_row[row]].inks[cell(x, y, row)] = plot_.inks[row];
            for (std::size_t i = 0; i < grids.size(); ++i)
                add_map(others.names[i], x, y, std::move(grids[i]), {});
        } else {
            for (const auto& values : panels_of_values())
                for (const RowValue* value : values) add_value_maps(*value, x, y, others, empty);
        }
        if (figure_.panels.size() > kMostPanels)
            throw PictureError(
                "too much varies for one picture: " + std::to_string(figure_.panels.size()) +
                " maps, at most " + std::to_string(kMostPanels));
        figure_.columns = figure_.panels.size() > 1 ? 2 : 1;
        figure_.shared_x = false;
        if (figure_.columns == 2) {
            figure_.width = 960;
            figure_.panel_height = 240;
        }
    }

    void add_value_maps(const RowValue& value, const VariedKey* x, const VariedKey* y,
                        const Combinations& others, const SampleGrid& empty) {
        const std::vector<double> numbers = column_numbers(records_, value.column);
        std::vector<SampleGrid> grids(others.names.size(), empty);
        for (SampleGrid& grid : grids)
            grid.values.assign(x->size() * y->size(), std::numeric_limits<double>::quiet_NaN());
        for (std::size_t row = 0; row < numbers.size(); ++row)
            grids[others.of_row[row]].values[cell(x, y, row)] = numbers[row];
        for (std::size_t i = 0; i < grids.size(); ++i)
            add_map(others.names[i], x, y, std::move(grids[i]), value.axis);
    }

    void add_map(const std::string& name, const VariedKey* x, const VariedKey* y, SampleGrid grid,
                 const FigureAxis& bar) {
        Panel panel{name, x->key->axis, y->key->axis};
        panel.grid = std::move(grid);
        panel.bar = bar;
        figure_.panels.push_back(std::move(panel));
    }

    void make_strips() {
        const VariedKey* x = longest();
        const Combinations others = others_than({x}, kMostCategories, "strips");
        const std::size_t count = others.names.size();
        Panel panel{"", x->key->axis, {}};
        SampleGrid grid{x->numbers, std::vector<double>(count), {}, {}};
        std::iota(grid.y.begin(), grid.y.end(), 0.0);
        grid.inks.assign(count * x->size(), ink(0xffffff));
        for (std::size_t row = 0; row < plot_.inks.size(); ++row)
            grid.inks[others.of_row[row] * x->size() + x->of_row[row]] = plot_.inks[row];
        panel.y.names = others.names;
        panel.y.first = static_cast<double>(count) - 0.5;  // the first on top
        panel.y.last = -0.5;
        panel.grid = std::move(grid);
        figure_.panel_height = 56 * static_cast<double>(count);
        figure_.panels.push_back(std::move(panel));
    }

    const Records& records_;
    const RowPlot& plot_;
    std::vector<VariedKey> keys_;
    std::vector<const VariedKey*> numbers_, categories_;  ///< those that vary
    Figure figure_;
};

struct KnownColumn {
    const char* name;
    FigureAxis axis;
};

const std::vector<KnownColumn>& known_columns() {
    static const std::vector<KnownColumn> known{
        {"wavelength_nm", {.quantity = "vacuum wavelength", .unit = "nm", .hues = true}},
        {"wavelength_um", {.quantity = "vacuum wavelength", .unit = "\u00b5m"}},
        {"energy_eV", {.quantity = "photon energy", .unit = "eV"}},
        {"wavenumber_per_cm", {.quantity = "wavenumber", .unit = "1/cm"}},
        {"angle_deg", {.quantity = "angle of incidence", .unit = "\u00b0"}},
        {"theta_deg", {.quantity = "angle of incidence", .unit = "\u00b0"}},
        {"cos_theta", {.quantity = "cosine of the angle of incidence"}},
        {"polarization", {.quantity = "polarization"}},
        {"side", {.quantity = "side"}},
        {"kind", {.quantity = "landmark"}},
        {"illuminant", {.quantity = "illuminant"}},
        {"order", {.quantity = "order", .step = 1}},
        {"R", {.quantity = "reflectance R", .from_zero = true}},
        {"T", {.quantity = "transmittance T", .from_zero = true}},
        {"A", {.quantity = "absorptance A", .from_zero = true}},
        {"r_re", {.quantity = "Re r"}},
        {"r_im", {.quantity = "Im r"}},
        {"t_re", {.quantity = "Re t"}},
        {"t_im", {.quantity = "Im t"}},
        {"psi_deg", {.quantity = "\u03c8", .unit = "\u00b0"}},
        {"delta_deg", {.quantity = "\u0394", .unit = "\u00b0", .period = 360}},
        {"delta_nebraska_deg",
         {.quantity = "\u0394 (instrument convention)", .unit = "\u00b0", .period = 360}},
        {"phase_r_deg", {.quantity = "phase of r", .unit = "\u00b0", .period = 360}},
        {"phase_t_deg", {.quantity = "phase of t", .unit = "\u00b0", .period = 360}},
        {"gd_r_fs", {.quantity = "group delay of r", .unit = "fs"}},
        {"gd_t_fs", {.quantity = "group delay of t", .unit = "fs"}},
        {"gdd_r_fs2", {.quantity = "GDD of r", .unit = "fs\u00b2"}},
        {"gdd_t_fs2", {.quantity = "GDD of t", .unit = "fs\u00b2"}},
        {"tod_r_fs3", {.quantity = "TOD of r", .unit = "fs\u00b3"}},
        {"tod_t_fs3", {.quantity = "TOD of t", .unit = "fs\u00b3"}},
        {"z_nm", {.quantity = "depth", .unit = "nm"}},
        {"medium", {.quantity = "medium", .step = 1}},
        {"E2", {.quantity = "|E|\u00b2", .from_zero = true}},
        {"largest_E2", {.quantity = "largest |E|\u00b2", .from_zero = true}},
        {"absorbed", {.quantity = "absorbed power", .from_zero = true}},
        {"absorbed_per_nm", {.quantity = "absorbed", .unit = "1/nm", .from_zero = true}},
        {"flux", {.quantity = "flux", .from_zero = true}},
        {"C", {.quantity = "coefficient C_m"}},
        {"short_nm", {.quantity = "short-wavelength edge", .unit = "nm"}},
        {"long_nm", {.quantity = "long-wavelength edge", .unit = "nm"}},
        {"light_theta_deg", {.quantity = "angle of the light", .unit = "\u00b0"}},
        {"light_phi_deg", {.quantity = "azimuth of the light", .unit = "\u00b0"}},
        {"view_theta_deg", {.quantity = "angle of the view", .unit = "\u00b0"}},
        {"view_phi_deg", {.quantity = "azimuth of the view", .unit = "\u00b0"}},
        {"brdf_per_sr", {.quantity = "BRDF", .unit = "1/sr", .from_zero = true}},
        {"radiance_ratio", {.quantity = "radiance over that of the light", .from_zero = true}},
        {"ft_cos", {.quantity = "light that passes straight", .from_zero = true}},
        {"p_trans", {.quantity = "probability of passing", .from_zero = true}},
        {"probability", {.quantity = "probability of sampling", .from_zero = true}},
        {"albedo", {.quantity = "albedo", .from_zero = true}},
        {"density", {.quantity = "density of scratches", .from_zero = true}},
        {"layer", {.quantity = "layer", .step = 1}},
        {"theta_i_deg", {.quantity = "angle of incidence", .unit = "\u00b0"}},
        {"theta_d_deg", {.quantity = "difference angle \u03b8d", .unit = "\u00b0"}},
        {"theta_h_deg", {.quantity = "half angle \u03b8h", .unit = "\u00b0"}},
        {"phi_d_deg", {.quantity = "difference azimuth \u03c6d", .unit = "\u00b0"}},
        {"alpha", {.quantity = "roughness \u03b1"}},
        {"opd_nm", {.quantity = "optical path difference", .unit = "nm"}},
        {"opd_sigma_nm", {.quantity = "\u03c3 of the optical path difference", .unit = "nm"}},
        {"thickness_sigma_nm", {.quantity = "\u03c3 of the thickness", .unit = "nm"}},
        {"F", {.quantity = "transmission filter F", .unit = "1/rad", .from_zero = true}},
    };
    return known;
}

/// "thickness of layer 1" for layers.0.thickness, "periods of layer 2" for layers.1.repeat; layers
/// are counted from 1, as in A_1, those of a group behind a point. Any other name as it is.
std::string words_of_path(const std::string& path) {
    constexpr std::string_view kStep = "layers.";
    std::string layer;
    std::size_t at = 0;
    while (path.compare(at, kStep.size(), kStep) == 0) {
        std::size_t number = 0;
        const char* const end = path.data() + path.size();
        const auto [rest, error] = std::from_chars(path.data() + at + kStep.size(), end, number);
        if (error != std::errc() || rest == end || *rest != '.') return path;
        layer += (layer.empty() ? "" : ".") + std::to_string(number + 1);
        at = static_cast<std::size_t>(rest - path.data()) + 1;
    }
    if (layer.empty()) return path;
    std::string quantity = path.substr(at);
    if (quantity == "repeat") quantity = "periods";
    std::ranges::replace(quantity, '_', ' ');
    return quantity + " of layer " + layer;
}

}  // namespace

FigureAxis axis_of_column(const std::string& name) {
    for (const KnownColumn& known : known_columns())
        if (known.name == name) return known.axis;
    if (name.starts_with("A_"))
        return {.quantity = "A of layer " + name.substr(2), .from_zero = true};
    FigureAxis axis{.quantity = name};
    for (const auto& [ending, unit] : {std::pair{"_nm", "nm"},
                                       {"_per_um", "1/\u00b5m"},
                                       {"_um", "\u00b5m"},
                                       {"_deg", "\u00b0"}}) {
        if (!name.ends_with(ending)) continue;
        axis.quantity.resize(name.size() - std::string_view(ending).size());
        axis.unit = unit;
    }
    axis.quantity = words_of_path(axis.quantity);
    return axis;
}

std::vector<double> column_numbers(const Records& records, const std::string& name) {
    std::vector<double> numbers(records.rows());
    std::visit(
        [&](const auto& values) {
            if constexpr (requires { numbers[0] = values[0]; })
                for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = values[i];
        },
        column_named(records, name).values);
    return numbers;
}

std::vector<std::string> column_texts(const Records& records, const std::string& name) {
    std::vector<std::string> texts(records.rows());
    std::visit(
        [&](const auto& values) {
            if constexpr (std::is_convertible_v<decltype(values[0]), std::string>)
                for (std::size_t i = 0; i < texts.size(); ++i) texts[i] = values[i];
        },
        column_named(records, name).values);
    return texts;
}

Figure figure_of(const Records& records, const RowPlot& plot) {
    return RowsFigure(records, plot).make();
}

}  // namespace irido::tables
