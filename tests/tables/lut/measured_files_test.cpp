// Files of measured BRDFs by readers of their own, written from the descriptions of the formats.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>

#include "core/math/constants.hpp"
#include "core/math/random.hpp"
#include "tables/lut/measured/measured_bsdf.hpp"
#include "tables/lut/measured/merl.hpp"
#include "tests/support/program.hpp"
#include "tests/support/sample_surfaces.hpp"

using namespace irido;
using namespace irido::test;
using Catch::Matchers::WithinRel;

namespace {

template <class Number>
Number number_at(const std::string& bytes, std::size_t offset) {
    Number value;
    REQUIRE(offset + sizeof value <= bytes.size());
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

struct Vec {
    double x, y, z;
    double dot(const Vec& o) const { return x * o.x + y * o.y + z * o.z; }
};

Vec direction(double theta_deg, double phi_deg) {
    const double t = theta_deg * kDegree, p = phi_deg * kDegree;
    return {std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)};
}

Vec half_of(const Vec& i, const Vec& o) {
    const Vec sum{i.x + o.x, i.y + o.y, i.z + o.z};
    const double length = std::sqrt(sum.dot(sum));
    return {sum.x / length, sum.y / length, sum.z / length};
}

/// The value of a MERL file for a pair of directions, in the way of its database's own reader.
std::array<double, 3> merl_value(const std::string& bytes, const Vec& i, const Vec& o) {
    const Vec h = half_of(i, o);
    const double theta_h = std::acos(std::min(1.0, h.z)), phi_h = std::atan2(h.y, h.x);
    // i turned back by phi_h about z, then by theta_h about y
    const double x = std::cos(phi_h) * i.x + std::sin(phi_h) * i.y;
    const double y = -std::sin(phi_h) * i.x + std::cos(phi_h) * i.y;
    const double dx = std::cos(theta_h) * x - std::sin(theta_h) * i.z;
    const double dz = std::sin(theta_h) * x + std::cos(theta_h) * i.z;
    double phi_d = std::atan2(y, dx);
    if (phi_d < 0) phi_d += kPi;
    const auto cell = [](double place, int count) {
        return static_cast<std::size_t>(std::clamp(static_cast<int>(place), 0, count - 1));
    };
    const std::size_t ih = cell(std::sqrt(theta_h / (kPi / 2)) * 90, 90);
    const std::size_t id = cell(std::acos(std::min(1.0, dz)) / (kPi / 2) * 90, 90);
    const std::size_t ip = cell(phi_d / kPi * 180, 180);
    const std::size_t at = (ih * 90 + id) * 180 + ip, all = 90 * 90 * 180;
    return {number_at<double>(bytes, 12 + 8 * at) / 1500,
            number_at<double>(bytes, 12 + 8 * (at + all)) * 1.15 / 1500,
            number_at<double>(bytes, 12 + 8 * (at + 2 * all)) * 1.66 / 1500};
}

struct Field {
    std::vector<std::uint64_t> shape;
    std::vector<float> numbers;
};

std::map<std::string, Field> fields_of(const std::string& bytes) {
    REQUIRE(bytes.compare(0, 12, std::string("tensor_file", 12)) == 0);
    CHECK(bytes[12] == 1);
    CHECK(bytes[13] == 0);
    std::map<std::string, Field> fields;
    std::size_t at = 18;
    for (auto count = number_at<std::uint32_t>(bytes, 14); count > 0; --count) {
        const auto length = number_at<std::uint16_t>(bytes, at);
        const std::string name = bytes.substr(at + 2, length);
        at += 2 + std::size_t{length};
        const auto dimensions = number_at<std::uint16_t>(bytes, at);
        const auto type = number_at<std::uint8_t>(bytes, at + 2);
        const auto offset = number_at<std::uint64_t>(bytes, at + 3);
        at += 11;
        Field field;
        std::size_t numbers = 1;
        for (int d = 0; d < dimensions; ++d, at += 8) {
            field.shape.push_back(number_at<std::uint64_t>(bytes, at));
            numbers *= field.shape.back();
        }
        CHECK(offset % 8 == 0);
        if (type == 10)
            for (std::size_t k = 0; k < numbers; ++k)
                field.numbers.push_back(number_at<float>(bytes, offset + 4 * k));
        fields[name] = field;
    }
    return fields;
}

/// Evaluates an isotropic spectral file at one of its wavelengths.
class MeasuredReader {
public:
    explicit MeasuredReader(const std::string& bytes) : fields_(fields_of(bytes)) {
        const Field& vndf = fields_.at("vndf");
        nodes_ = vndf.shape[3];
        samples_ = fields_.at("spectra").shape[4];
    }

    /// BRDF times cos(theta_o).
    double operator()(const Vec& i, const Vec& o, std::size_t wavelength) const {
        const Vec m = half_of(i, o);
        const double theta_i = std::acos(std::min(1.0, i.z));
        const double phi = std::atan2(m.y, m.x) - std::atan2(i.y, i.x);
        const double wrapped = phi - 2 * kPi * std::floor((phi + kPi) / (2 * kPi));
        const double x = std::sqrt(2 * std::acos(std::min(1.0, m.z)) / kPi);
        const double y = (wrapped + kPi) / (2 * kPi);
        // between the slices of theta_i
        const std::vector<float>& thetas = fields_.at("theta_i").numbers;
        std::size_t t = 0;
        while (t + 2 < thetas.size() && static_cast<double>(thetas[t + 1]) <= theta_i) ++t;
        const double share = std::clamp((theta_i - static_cast<double>(thetas[t])) /
                                            static_cast<double>(thetas[t + 1] - thetas[t]),
                                        0.0, 1.0);
        const auto [sx, sy] = sample_of(t, share, x, y);
        const double value = (1 - share) * spectrum(t, wavelength, sx, sy) +
                             share * spectrum(t + 1, wavelength, sx, sy);
        return value * at("ndf", x) / (4 * at("sigma", std::sqrt(2 * theta_i / kPi)));
    }

private:
    double at(const std::string& name, double x) const {
        const Field& field = fields_.at(name);
        const double place = x * static_cast<double>(field.shape[1] - 1);
        const std::size_t k = std::min(static_cast<std::size_t>(place), field.shape[1] - 2);
        const double u = place - static_cast<double>(k);
        return (1 - u) * static_cast<double>(field.numbers[k]) +
               u * static_cast<double>(field.numbers[k + 1]);
    }

    /// Cumulative sums of the visible normals, between two slices: of a row up to x, and of rows.
    double row_sum(std::size_t t, std::size_t j, double x) const {
        const float* row = fields_.at("vndf").numbers.data() + (t * nodes_ + j) * nodes_;
        const double place = x * static_cast<double>(nodes_ - 1);
        const std::size_t last = std::min(static_cast<std::size_t>(place), nodes_ - 2);
        double sum = 0;
        for (std::size_t k = 0; k < last; ++k)
            sum += 0.5 * static_cast<double>(row[k] + row[k + 1]);
        const double u = place - static_cast<double>(last), a = static_cast<double>(row[last]);
        return sum + u * a + 0.5 * u * u * (static_cast<double>(row[last + 1]) - a);
    }

    std::pair<double, double> sample_of(std::size_t t, double share, double x, double y) const {
        const double place = y * static_cast<double>(nodes_ - 1);
        const std::size_t j = std::min(static_cast<std::size_t>(place), nodes_ - 2);
        const double v = place - static_cast<double>(j);
        double sx = 0, sy = 0, width = 0;
        for (const auto& [slice, part] : {std::pair(t, 1 - share), std::pair(t + 1, share)}) {
            std::vector<double> totals;
            double all = 0;
            for (std::size_t k = 0; k < nodes_; ++k) totals.push_back(row_sum(slice, k, 1));
            for (std::size_t k = 0; k + 1 < nodes_; ++k) all += 0.5 * (totals[k] + totals[k + 1]);
            double below = 0;
            for (std::size_t k = 0; k < j; ++k) below += 0.5 * (totals[k] + totals[k + 1]);
            below += v * totals[j] + 0.5 * v * v * (totals[j + 1] - totals[j]);
            sy += part * below / all;
            const double whole = (1 - v) * totals[j] + v * totals[j + 1];
            sx += part * ((1 - v) * row_sum(slice, j, x) + v * row_sum(slice, j + 1, x)) / all;
            width += part * whole / all;
        }
        return {width > 0 ? sx / width : 0, sy};
    }

    double spectrum(std::size_t t, std::size_t wavelength, double sx, double sy) const {
        const Field& field = fields_.at("spectra");
        const std::size_t N = samples_;
        const float* grid = field.numbers.data() + (t * field.shape[2] + wavelength) * N * N;
        const double px = sx * static_cast<double>(N - 1), py = sy * static_cast<double>(N - 1);
        const std::size_t i = std::min(static_cast<std::size_t>(px), N - 2);
        const std::size_t j = std::min(static_cast<std::size_t>(py), N - 2);
        const double u = px - static_cast<double>(i), v = py - static_cast<double>(j);
        const auto value = [&](std::size_t row, std::size_t column) {
            return static_cast<double>(grid[row * N + column]);
        };
        return (1 - v) * ((1 - u) * value(j, i) + u * value(j, i + 1)) +
               v * ((1 - u) * value(j + 1, i) + u * value(j + 1, i + 1));
    }

    std::map<std::string, Field> fields_;
    std::size_t nodes_ = 0, samples_ = 0;
};

}  // namespace

TEST_CASE("a MERL file", "[tables][measured]") {
    tables::MerlReport report;
    // of the angle between the directions
    const auto smooth = [](double theta_i_deg, double theta_o_deg, double near) {
        const double i = theta_i_deg * kDegree, o = theta_o_deg * kDegree;
        return 1 + 0.5 * (std::cos(i) * std::cos(o) +
                          std::sin(i) * std::sin(o) * (2 * near * near - 1));
    };
    const std::string bytes = tables::merl_file(
        [&](const tables::TablePair& pair) {
            const double value = smooth(pair.theta_i_deg, pair.theta_o_deg, pair.near);
            return Triple{value, 2 * value, -1};
        },
        2, report);
    REQUIRE(bytes.size() == 34992012);
    CHECK(number_at<std::int32_t>(bytes, 0) == 90);
    CHECK(number_at<std::int32_t>(bytes, 8) == 180);
    CHECK(report.cells == 1458000);
    CHECK(report.below > 300000);
    CHECK(report.clamped == report.cells - report.below);
    Random random(3);
    for (int k = 0; k < 2000; ++k) {
        const double ti = random.uniform(0, 75), to = random.uniform(0, 75);
        const double phi = random.uniform(0, 180);
        const auto [r, g, b] = merl_value(bytes, direction(ti, 40), direction(to, 40 + phi));
        const double expected = smooth(ti, to, std::cos(phi * kDegree / 2));
        CHECK(std::abs(r - expected) < 0.06);  // a cell is up to 2 degrees wide
        CHECK_THAT(g, WithinRel(2 * r, 1e-12));
        CHECK(b == 0);
    }
    // no direction above the horizon is black, however grazing
    for (int k = 0; k < 2000; ++k) {
        const double phi = random.uniform(0, 180);
        CHECK(merl_value(bytes, direction(random.uniform(80, 89.9), 0),
                         direction(random.uniform(0, 89.9), phi))[0] > 0);
    }
}

TEST_CASE("a measured BSDF", "[tables][measured][slow]") {
    const LayeredScattering scattering(
        surface_of(R"({"layers": [{"stack": "1 | 1.5@300 | 1", "alpha": 0.2}],
                       "base": {"albedo": 0.3}})"),
        Crossings::single, Execution(0));
    tables::MeasuredBsdf bsdf;
    bsdf.description = "a film";
    bsdf.alpha = 0.2;
    bsdf.wavelength_nm = {450, 650};
    for (int t = 0; t <= 32; ++t) bsdf.theta_i_deg.push_back(89.9 * t / 32);
    const std::string bytes = tables::measured_bsdf(bsdf, [&](std::span<const ScatterPair> pairs) {
        return scattering.brdf(pairs, bsdf.wavelength_nm, Paths::single);
    });
    const MeasuredReader reader(bytes);
    Random random(5);
    std::vector<double> errors;
    for (int k = 0; k < 300; ++k) {
        const ScatterPair pair{random.uniform(0, 70), random.uniform(0, 70),
                               random.uniform(0, 180)};
        const double expected = scattering.brdf({&pair, 1}, {450}, Paths::single)[0] *
                                std::cos(pair.theta_o_deg * kDegree);
        const double got = reader(direction(pair.theta_i_deg, 20),
                                  direction(pair.theta_o_deg, 20 + pair.phi_deg), 0);
        errors.push_back(std::abs(got / expected - 1));
    }
    std::ranges::sort(errors);
    CHECK(errors[errors.size() / 2] < 0.01);
    CHECK(errors[errors.size() * 95 / 100] < 0.08);
}

TEST_CASE("lut brdf refuses what it cannot write", "[cli][brdf]") {
    const TemporaryFolder folder;
    const std::string pale = "schemas/examples/surfaces/green-on-pale.json";
    check_refused(run_irido({"lut", "brdf", pale, "-o", folder / "x.csv"}),
                  "must be one of binary, merl, bsdf");
    check_refused(run_irido({"lut", "brdf", pale, "-f", "merl"}), "--output: is required");
    check_refused(run_irido({"lut", "brdf", pale, "--paths", "all", "-o", folder / "x.bsdf"}),
                  "--paths all: requires a closed form");
    check_refused(run_irido({"lut", "brdf", pale, "-w", "500,400", "-o", folder / "x.bsdf"}),
                  "--wavelengths: must ascend");
}
