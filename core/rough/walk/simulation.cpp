#include "core/rough/walk/simulation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "core/coherent/coherent.hpp"
#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/math/parallel.hpp"
#include "core/math/philox.hpp"
#include "core/rough/layered/lobe.hpp"

namespace irido {

namespace {

/// Parts in which samples are added up, whatever the number of threads.
constexpr std::size_t kParts = 64;

/// A path that is not stopped otherwise: the part of the light that is left is nothing.
constexpr int kMostVertices = 100000;

double mean_of(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// A direction relative to the plane of the one it comes from.
struct Turn {
    double cos = 1, sin = 0;  ///< of the polar angle
    double azimuth = 0;       ///< radians
};

struct SampledFacet {
    double theta_d_deg = 0;
    Turn mirrored;  ///< where it reflects to; cos <= 0: into the surface
};

/// A facet of those that a direction sees, distributed as D <i.m> G1 / cos i. Source: E. Heitz,
/// JCGT 7(4), 1 (2018).
SampledFacet visible_facet(double alpha, double cos_i, double sin_i, double u, double v) {
    // the direction where the facets are a hemisphere
    const double length = std::hypot(alpha * sin_i, cos_i);
    const double x = alpha * sin_i / length, z = cos_i / length;
    const double r = std::sqrt(u), phi = 2 * kPi * v;
    const double t1 = r * std::cos(phi);
    const double s = 0.5 * (1 + z);
    const double t2 = (1 - s) * std::sqrt(std::max(0.0, 1 - t1 * t1)) + s * r * std::sin(phi);
    const double t3 = std::sqrt(std::max(0.0, 1 - t1 * t1 - t2 * t2));
    // axes across: T1 = y, T2 = direction x T1
    std::array<double, 3> m{alpha * (-z * t2 + x * t3), alpha * t1,
                            std::max(1e-12, x * t2 + z * t3)};
    const double norm = std::sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
    for (double& part : m) part /= norm;
    const double across = std::min(1.0, std::max(0.0, sin_i * m[0] + cos_i * m[2]));
    const double ox = 2 * across * m[0] - sin_i, oy = 2 * across * m[1];
    const double oz = 2 * across * m[2] - cos_i;
    return {std::acos(across) / kDegree, {oz, std::hypot(ox, oy), std::atan2(oy, ox)}};
}

}  // namespace

LayeredSimulation::LayeredSimulation(const LayeredScattering& scattering,
                                     const SimulationRequest& request,
                                     const std::vector<double>& wavelength_nm,
                                     const Execution& execution)
    : scattering_(scattering),
      request_(request),
      wavelengths_(wavelength_nm.size()),
      execution_(execution) {
    for (const double nm : wavelength_nm)
        base_.push_back(scattering.has_base() ? scattering.base_albedo(nm) : 0);
    for (std::size_t l = 0; l < scattering.layers(); ++l) {
        facets_.push_back(facet_table(scattering.layer(l), wavelength_nm, execution.threads));
        if (request.facets == FacetChoice::filter)
            straight_.push_back(straight_table(scattering.layer(l), wavelength_nm,
                                               request.crossings, execution.threads));
    }
}

/// One path after another of light from one direction.
class LayeredSimulation::Walk {
public:
    Walk(const LayeredSimulation& of, std::span<const ScatterPair> pairs, double theta_i_deg,
         bool is_albedo)
        : of_(of),
          scattering_(of.scattering_),
          in_(scattering_.coating().inward(theta_i_deg)),
          is_albedo_(is_albedo),
          W_(of.wavelengths_),
          weight_(W_),
          power_(2 * W_),
          straight_(W_),
          out_(W_) {
        for (const ScatterPair& pair : pairs) {
            const Coating::Crossing o = scattering_.coating().inward(pair.theta_o_deg);
            seen_.push_back({o.theta_deg, incident_angle(o.theta_deg),
                             o.T * scattering_.coating().dilution(), pair.phi_deg * kDegree});
        }
        sample_.resize((is_albedo ? 1 : pairs.size()) * W_);
    }

    /// What one path gives: [pair][wavelength], or the albedo at each wavelength.
    std::span<const double> operator()(PhiloxSequence random) {
        std::ranges::fill(sample_, 0);
        std::ranges::fill(weight_, in_.T);
        if (is_albedo_)
            for (double& value : sample_) value = in_.R;
        if (in_.T > 0) run(random);
        return sample_;
    }

private:
    struct Ray {
        double cos = 1, sin = 0, azimuth = 0;  ///< radians
    };
    struct Seen {
        double theta_deg;
        IncidentAngle angle;
        double factor, azimuth;
    };

    bool is_single() const { return of_.request_.paths == Paths::single; }
    std::size_t layers() const { return scattering_.layers(); }

    void run(PhiloxSequence& random) {
        const IncidentAngle first = incident_angle(in_.theta_deg);
        ray_ = {first.cos, first.sin, kPi};
        reflected_ = false;
        std::size_t place = 0;  // layers above the ray
        bool down = true;
        for (int vertex = 0; vertex < kMostVertices; ++vertex) {
            if (down && place == layers()) {
                if (!reflect_at_base(random)) return;
                down = false;
            } else if (!down && place == 0) {
                if (!leave(random)) return;
                down = true;
            } else {
                const std::size_t layer = down ? place : place - 1;
                switch (meet(layer, down, random)) {
                    case Event::lost:
                        return;
                    case Event::passed:
                        place = down ? place + 1 : place - 1;
                        break;
                    case Event::reflected:
                        down = !down;
                        break;
                }
                if (!scattering_.surface().layers[layer].is_passable && down && place > layer)
                    return;
            }
            if (vertex >= 3 && !survives(random)) return;
        }
    }

    bool survives(PhiloxSequence& random) {
        const double left = *std::ranges::max_element(weight_);
        if (left >= 0.5) return true;
        if (left <= 0 || random.next() >= 2 * left) return false;
        for (double& weight : weight_) weight /= 2 * left;
        return true;
    }

    enum class Event { lost, passed, reflected };

    /// Light meets a layer, from above or from below.
    Event meet(std::size_t l, bool down, PhiloxSequence& random) {
        const double alpha = scattering_.layer(l).alpha();
        if (down && !is_albedo_ && !(is_single() && reflected_)) connect(l, random);
        const double u = random.next(), v = random.next();
        const SampledFacet facet = visible_facet(alpha, ray_.cos, ray_.sin, u, v);
        of_.facets_[l].at(facet.theta_d_deg, power_);
        const std::span<const double> R = std::span(power_).first(W_);
        const double G1 = ray_.cos * visibility(alpha, ray_.cos, ray_.sin);
        if (of_.request_.facets == FacetChoice::filter) {
            of_.straight_[l].at(std::atan2(ray_.sin, ray_.cos) / kDegree, straight_);
            for (double& value : straight_) value *= G1;
        } else {
            for (std::size_t w = 0; w < W_; ++w) straight_[w] = power_[W_ + w] * G1;
        }
        const Turn& o = facet.mirrored;
        const bool may_reflect = o.cos > 0 && !(is_single() && reflected_);
        const double G1_o = may_reflect ? o.cos * visibility(alpha, o.cos, o.sin) : 0;
        double p = 1;
        if (of_.request_.facets == FacetChoice::filter) {
            if (!(is_single() && reflected_)) p = std::min(1.0, 2 * mean_of(straight_) / (1 + G1));
        } else {
            double reflected = 0, passed = 0;
            for (std::size_t w = 0; w < W_; ++w) {
                reflected += weight_[w] * R[w] * G1_o;
                passed += weight_[w] * straight_[w];
            }
            if (reflected + passed <= 0) return Event::lost;
            p = passed / (reflected + passed);
        }
        if (random.next() < p) {
            for (std::size_t w = 0; w < W_; ++w) weight_[w] *= straight_[w] / p;
            return Event::passed;
        }
        if (!may_reflect) return Event::lost;
        for (std::size_t w = 0; w < W_; ++w) weight_[w] *= R[w] * G1_o / (1 - p);
        reflected_ = true;
        // the direction it comes from lies opposite to the one it travels in
        ray_ = {o.cos, o.sin, ray_.azimuth + kPi + o.azimuth};
        return Event::reflected;
    }

    bool reflect_at_base(PhiloxSequence& random) {
        if (is_single() && reflected_) return false;
        if (mean_of(of_.base_) <= 0) return false;
        if (!is_albedo_)
            for (std::size_t k = 0; k < seen_.size(); ++k) {
                through(layers(), seen_[k], random);
                for (std::size_t w = 0; w < W_; ++w)
                    sample_[k * W_ + w] +=
                        weight_[w] * of_.base_[w] / kPi * seen_[k].factor * out_[w];
            }
        for (std::size_t w = 0; w < W_; ++w) weight_[w] *= of_.base_[w];
        const double u = random.next();
        ray_ = {std::sqrt(1 - u), std::sqrt(u), 2 * kPi * random.next()};
        reflected_ = true;
        return true;
    }

    /// Part of the light gets out, the rest is reflected by the coating.
    bool leave(PhiloxSequence& random) {
        const Coating& coating = scattering_.coating();
        const double T = coating.outward_transmittance(std::min(1.0, ray_.cos));
        if (is_albedo_)
            for (std::size_t w = 0; w < W_; ++w) sample_[w] += weight_[w] * T;
        if (is_single() || T >= 1) return false;
        if (random.next() >= 1 - T) return false;
        return true;  // its azimuth stays, and so does its weight: (1 - T)/(1 - T)
    }

    /// What the facets between layer l and the outside let through on the way to a direction.
    void through(std::size_t l, const Seen& seen, PhiloxSequence& random) {
        std::ranges::fill(out_, 1);
        for (std::size_t k = l; k-- > 0;) {
            const double alpha = scattering_.layer(k).alpha();
            const double G1 = seen.angle.cos * visibility(alpha, seen.angle.cos, seen.angle.sin);
            if (of_.request_.facets == FacetChoice::filter) {
                of_.straight_[k].at(seen.theta_deg, straight_);
                for (std::size_t w = 0; w < W_; ++w) out_[w] *= G1 * straight_[w];
                continue;
            }
            const double u = random.next(), v = random.next();
            const SampledFacet facet = visible_facet(alpha, seen.angle.cos, seen.angle.sin, u, v);
            of_.facets_[k].at(facet.theta_d_deg, power_);
            for (std::size_t w = 0; w < W_; ++w) out_[w] *= G1 * power_[W_ + w];
        }
    }

    /// Light that layer l would reflect towards the directions asked for.
    void connect(std::size_t l, PhiloxSequence& random) {
        const double alpha = scattering_.layer(l).alpha();
        const double theta = std::atan2(ray_.sin, ray_.cos) / kDegree;
        for (std::size_t k = 0; k < seen_.size(); ++k) {
            const Seen& seen = seen_[k];
            if (seen.factor <= 0) continue;
            const double half = 0.5 * (seen.azimuth - (ray_.azimuth + kPi));
            const MirrorFacet facet = MirrorFacets(std::clamp(theta, 0.0, 90.0), seen.theta_deg)(
                std::abs(std::cos(half)), std::abs(std::sin(half)));
            through(l, seen, random);
            of_.facets_[l].at(facet.theta_d_deg, power_);
            const double scale = lobe(alpha, facet) * seen.factor;
            for (std::size_t w = 0; w < W_; ++w)
                sample_[k * W_ + w] += weight_[w] * power_[w] * out_[w] * scale;
        }
    }

    const LayeredSimulation& of_;
    const LayeredScattering& scattering_;
    Coating::Crossing in_;
    bool is_albedo_;
    std::size_t W_;
    std::vector<Seen> seen_;
    std::vector<double> weight_, power_, straight_, out_, sample_;
    Ray ray_;  ///< where the light travels
    bool reflected_ = false;
};

LayeredSimulation::Values LayeredSimulation::simulated(std::span<const ScatterPair> pairs,
                                                       double theta_i_deg, std::uint32_t light,
                                                       bool is_albedo) const {
    const std::size_t things = is_albedo ? 1 : pairs.size(), size = things * numbers();
    const bool has_colors = !colors_[0].empty();
    std::vector<LongSum> sums(kParts * size), squares(kParts * size);
    const auto key = philox_key(request_.seed);
    parallel_for(kParts, execution_.threads, [&](std::size_t part) {
        Walk walk(*this, pairs, theta_i_deg, is_albedo);
        std::vector<double> colors(has_colors ? size : 0);
        LongSum* const sum = sums.data() + part * size;
        LongSum* const square = squares.data() + part * size;
        const std::uint64_t begin = request_.first + request_.samples / kParts * part +
                                    std::min<std::uint64_t>(part, request_.samples % kParts);
        const std::uint64_t count = request_.samples / kParts + (part < request_.samples % kParts);
        for (std::uint64_t n = begin; n < begin + count; ++n) {
            std::span<const double> sample = walk(
                {key, {static_cast<std::uint32_t>(n), static_cast<std::uint32_t>(n >> 32), light}});
            if (has_colors) {
                for (std::size_t k = 0; k < size; ++k)
                    colors[k] = std::inner_product(
                        colors_[k % 3].begin(), colors_[k % 3].end(),
                        sample.begin() + static_cast<std::ptrdiff_t>(k / 3 * wavelengths_), 0.0);
                sample = colors;
            }
            for (std::size_t k = 0; k < size; ++k) {
                sum[k].add(sample[k]);
                square[k].add(sample[k] * sample[k]);
            }
        }
    });
    Values values;
    values.samples = request_.samples;
    values.sum.resize(size);
    values.square.resize(size);
    for (std::size_t part = 0; part < kParts; ++part)
        for (std::size_t k = 0; k < size; ++k) {
            values.sum[k].add(sums[part * size + k]);
            values.square[k].add(squares[part * size + k]);
        }
    values.set_means();
    return values;
}

void LayeredSimulation::Values::set_means() {
    const auto N = static_cast<double>(samples);
    mean.resize(sum.size());
    error.resize(sum.size());
    for (std::size_t k = 0; k < sum.size(); ++k) {
        mean[k] = sum[k].value() / N;
        error[k] = std::sqrt(std::max(0.0, square[k].value() / N - mean[k] * mean[k]) / (N - 1));
    }
}

void LayeredSimulation::Values::add(const Values& others) {
    samples += others.samples;
    for (std::size_t k = 0; k < sum.size(); ++k) {
        sum[k].add(others.sum[k]);
        square[k].add(others.square[k]);
    }
    set_means();
}

namespace {

/// Copies the values of some rows; there is room for them.
void put(const LayeredSimulation::Values& from, std::size_t first, std::size_t count,
         std::size_t place, LayeredSimulation::Values& to) {
    const auto copy = [&](const auto& some, auto& all) {
        std::copy_n(some.begin() + static_cast<std::ptrdiff_t>(first), count,
                    all.begin() + static_cast<std::ptrdiff_t>(place));
    };
    copy(from.mean, to.mean);
    copy(from.error, to.error);
    copy(from.sum, to.sum);
    copy(from.square, to.square);
}

LayeredSimulation::Values room_for(std::size_t size, std::uint64_t samples) {
    LayeredSimulation::Values values;
    values.samples = samples;
    values.mean.resize(size);
    values.error.resize(size);
    values.sum.resize(size);
    values.square.resize(size);
    return values;
}

}  // namespace

LayeredSimulation::Values LayeredSimulation::brdf(std::span<const ScatterPair> pairs) const {
    std::map<double, std::vector<std::size_t>> lights;
    for (std::size_t p = 0; p < pairs.size(); ++p) lights[pairs[p].theta_i_deg].push_back(p);
    const std::size_t size = numbers();
    Values all = room_for(pairs.size() * size, request_.samples);
    std::uint32_t light = 0;
    for (const auto& [theta, places] : lights) {
        std::vector<ScatterPair> some;
        for (const std::size_t p : places) some.push_back(pairs[p]);
        const Values values = simulated(some, theta, light++, false);
        for (std::size_t k = 0; k < places.size(); ++k)
            put(values, k * size, size, places[k] * size, all);
    }
    return all;
}

LayeredSimulation::Values LayeredSimulation::albedo(std::span<const double> theta_i_deg) const {
    const std::size_t size = numbers();
    Values all = room_for(theta_i_deg.size() * size, request_.samples);
    for (std::size_t i = 0; i < theta_i_deg.size(); ++i)
        put(simulated({}, theta_i_deg[i], static_cast<std::uint32_t>(i), true), 0, size, i * size,
            all);
    return all;
}

}  // namespace irido
