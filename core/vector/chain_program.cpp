#include "core/vector/chain_program.hpp"

#include <algorithm>
#include <cmath>

#include "core/incoherent/incoherent.hpp"
#include "core/keep_once.hpp"

namespace irido {

namespace {

double value_at(const Stream& stream, std::size_t point) {
    return stream.values[stream.varies ? point : 0];
}

/// What the kernel's stand-in for a kz of 0 can leave of A in a gap without absorption.
constexpr double kNoAbsorption = 1e-130;

/// What is computed besides powers.
enum class BlockExtra { none, denominators, amplitude };

/// Powers of all points of a run in one polarization.
struct BlockRun {
    std::vector<double> R, T, A, denominator_re, denominator_im, log_scale;
    std::vector<Complex> r;

    BlockRun(std::size_t points, BlockExtra extra) : R(points), T(points), A(points) {
        if (extra == BlockExtra::amplitude) r.resize(points);
        if (extra != BlockExtra::denominators) return;
        for (auto* values : {&denominator_re, &denominator_im, &log_scale}) values->resize(points);
    }
    RunOutput output() {
        RunOutput out{.R = R.data(), .T = T.data(), .A = A.data()};
        if (!r.empty()) out.r = r.data();
        if (log_scale.empty()) return out;
        out.denominator_re = denominator_re.data();
        out.denominator_im = denominator_im.data();
        out.log_scale = log_scale.data();
        return out;
    }
    Power power(std::size_t point) const {
        const bool none = A[point] < 0 && A[point] > -kNoAbsorption;
        return {R[point], T[point], none ? 0 : A[point]};
    }
    Complex denominator(std::size_t point) const {
        return {denominator_re[point], denominator_im[point]};
    }
};

/// Both polarizations of one direction through one block.
struct BothRuns {
    BlockRun s, p;

    BothRuns(const Program& program, const PointRun& run, bool with_s, bool with_p,
             BlockExtra extra, std::vector<std::size_t>& redo, RunMemory& memory, SimdLevel level)
        : s(with_s ? run.count : 0, extra), p(with_p ? run.count : 0, extra) {
        const RunOutput out_s = s.output(), out_p = p.output();
        run_program(program, run, with_s ? &out_s : nullptr, with_p ? &out_p : nullptr, redo,
                    memory, level);
    }
};

/// What lies below a block, point by point.
struct Below {
    std::vector<Power> power;
    std::vector<Complex> denominator;
    std::vector<double> log_scale;

    explicit Below(const BlockRun& last) : power(last.R.size()), log_scale(last.log_scale) {
        for (std::size_t i = 0; i < power.size(); ++i) power[i] = last.power(i);
        for (std::size_t i = 0; i < log_scale.size(); ++i)
            denominator.push_back(last.denominator(i));
    }

    void add(const BlockRun& down, const BlockRun& up, const std::vector<Attenuation>& gap,
             const std::vector<char>& lost) {
        for (std::size_t i = 0; i < power.size(); ++i)
            if (!lost[i]) power[i] = over_gap({down.power(i), up.power(i)}, gap[i], power[i]);
        for (std::size_t i = 0; i < denominator.size(); ++i) {
            const double size = std::abs(down.denominator(i));
            denominator[i] *= down.denominator(i) / size;
            log_scale[i] += down.log_scale[i] + std::log(size);
        }
    }

    void store(const RunOutput& out) const {
        for (std::size_t i = 0; i < power.size(); ++i) {
            const std::size_t at = i * out.stride;
            if (out.R) out.R[at] = power[i].R;
            if (out.T) out.T[at] = power[i].T;
            if (out.A) out.A[at] = power[i].A;
            if (out.log_scale) {
                out.denominator_re[at] = denominator[i].real();
                out.denominator_im[at] = denominator[i].imag();
                out.log_scale[at] = log_scale[i];
            }
        }
    }
};

Medium medium_of_gap(const Layer& gap, const PointRun& run, std::size_t point) {
    const Complex index{value_at(run.n[gap.material], point), value_at(run.k[gap.material], point)};
    const IncidentAngle at{value_at(run.cos_theta, point), value_at(run.sin_theta, point)};
    return medium(index, value_at(run.incident, point), at);
}

/// Of a gap; `redo` receives the points at which it is no gap, or has not its own wave.
std::vector<Attenuation> attenuations(const Layer& gap, const PointRun& run,
                                      std::vector<std::size_t>& redo) {
    std::vector<Attenuation> result;
    for (std::size_t i = 0; i < run.count; ++i) {
        const Medium inside = medium_of_gap(gap, run, i);
        const double k0_d = value_at(run.k0, i) * gap.thickness_nm;
        if (!travels(inside) || k0_d == 0 || !has_own_wave(inside, k0_d)) redo.push_back(i);
        result.push_back(attenuation(inside, k0_d));
    }
    return result;
}

/// The points seen from above a block.
class RunFrom {
public:
    RunFrom(const ChainProgram& chain, const PointRun& run)
        : chain_(chain), run_(run), from_gap_(run) {}

    const PointRun& operator()(std::size_t block) {
        if (block == 0) return run_;
        from_gap_.above = chain_.gaps[block - 1].material;
        return from_gap_;
    }

private:
    const ChainProgram& chain_;
    const PointRun& run_;
    PointRun from_gap_;
};

/// Absorption of the layers in one polarization, as ChainLight::layer_absorption().
class LayersOfPolarization {
public:
    LayersOfPolarization(const LayerOutput& out, const ChainProgram& chain, const PointRun& run,
                         Polarization polarization, const std::vector<char>& lost)
        : out_(out), chain_(chain), run_(run), polarization_(polarization), lost_(lost) {}

    std::vector<const BlockRun*> downs, ups;

    bool is_s() const { return polarization_ == Polarization::s; }

    /// The light that falls on each block, and what each gap absorbs; call first.
    void find_light(const std::vector<std::vector<Attenuation>>& gaps) {
        const std::size_t last = gaps.size(), points = run_.count;
        from_above_.assign(last + 1, std::vector<double>(points, 1));
        from_below_.assign(last, std::vector<double>(points));
        in_gap_.assign(last, std::vector<double>(points));
        std::vector<Power> from(last + 1);
        for (std::size_t point = 0; point < points; ++point) {
            if (lost_[point]) continue;
            const auto block = [&](std::size_t i) -> BlockPower {
                return {downs[i]->power(point), ups[i]->power(point)};
            };
            from[last] = downs[last]->power(point);
            for (std::size_t i = last; i-- > 0;)
                from[i] = over_gap(block(i), gaps[i][point], from[i + 1]);
            for (std::size_t i = 0; i < last; ++i) {
                const Attenuation& loss = gaps[i][point];
                const LightInGap light = light_in_gap(block(i), loss, from[i + 1]);
                const double incident = from_above_[i][point];
                const double arriving = incident * light.arriving;
                const double returned = incident * light.returned;
                const Layer& gap = chain_.gaps[i];
                const Wave wave =
                    wave_in_gap(medium_of_gap(gap, run_, point),
                                value_at(run_.k0, point) * gap.thickness_nm, polarization_);
                in_gap_[i][point] =
                    loss.lost * (incident * light.entering + arriving * from[i + 1].R) +
                    arriving * mixed_power(wave, downs[i + 1]->r[point]) +
                    returned * mixed_power(wave, ups[i]->r[point]);
                from_above_[i + 1][point] = arriving;
                from_below_[i][point] = returned;
            }
        }
    }

    /// Adds what a block's layers absorb of the light from above or, later, from below.
    void add_block(std::size_t i, bool from_below, const ChainLayers::Block& block,
                   const std::vector<double>& parts) {
        const std::vector<double>& light = from_below ? from_below_[i] : from_above_[i];
        for (std::uint32_t layer = block.first; layer < block.end; ++layer) {
            const double* part = parts.data() + (layer - block.first) * run_.count;
            for (std::size_t point = 0; point < run_.count; ++point) {
                double& to = place(layer, point);
                to = (from_below ? to : 0) + light[point] * part[point];
            }
        }
    }

    void add_gap(std::size_t i, std::uint32_t layer) {
        for (std::size_t point = 0; point < run_.count; ++point)
            place(layer, point) = in_gap_[i][point];
    }

private:
    double& place(std::uint32_t layer, std::size_t point) {
        return out_.A[layer * out_.layer_stride + point * out_.stride];
    }

    const LayerOutput& out_;
    const ChainProgram& chain_;
    const PointRun& run_;
    Polarization polarization_;
    const std::vector<char>& lost_;
    std::vector<std::vector<double>> from_above_, from_below_;  ///< per block and point
    std::vector<std::vector<double>> in_gap_;                   ///< per gap and point
};

}  // namespace

bool compile(const Chain& chain, const std::vector<bool>& absorbs,
             const std::vector<bool>& amplifies, bool needs_A, const FixedRuns& fixed,
             ChainProgram& program) {
    program.gaps = chain.gaps;
    program.down.resize(chain.blocks.size());
    program.up.resize(chain.gaps.size());
    for (std::size_t i = 0; i < chain.blocks.size(); ++i) {
        const bool last = i == chain.gaps.size();
        const std::size_t below = last ? chain.substrate : chain.gaps[i].material;
        if (!last && amplifies[below]) return false;
        if (!compile(chain.blocks[i].down, below, absorbs, needs_A, fixed, program.down[i]))
            return false;
        if (last) break;
        // above the first block is the incident medium, which does not absorb
        const std::size_t above = i == 0 ? Program::kIncident : chain.gaps[i - 1].material;
        if (!compile(chain.blocks[i].up, above, absorbs, needs_A, fixed, program.up[i]))
            return false;
    }
    return true;
}

void run_chain(const ChainProgram& chain, const PointRun& run, const RunOutput* s,
               const RunOutput* p, std::vector<std::size_t>& redo, RunMemory& memory,
               SimdLevel level) {
    const std::size_t last = chain.gaps.size();
    if (last == 0) return run_program(chain.down[0], run, s, p, redo, memory, level);
    const bool with_denominators = (s && s->log_scale) || (p && p->log_scale);
    const BlockExtra extra = with_denominators ? BlockExtra::denominators : BlockExtra::none;
    RunFrom above(chain, run);
    const auto pass = [&](const Program& program, const PointRun& points) {
        return BothRuns(program, points, s, p, extra, redo, memory, level);
    };
    const BothRuns bottom = pass(chain.down[last], above(last));
    Below below_s(bottom.s), below_p(bottom.p);
    std::vector<char> lost(run.count);
    for (std::size_t i = last; i-- > 0;) {
        const BothRuns down = pass(chain.down[i], above(i));
        const BothRuns up = pass(chain.up[i], above(i + 1));
        const std::vector<Attenuation> gap = attenuations(chain.gaps[i], run, redo);
        for (const std::size_t point : redo) lost[point] = 1;
        below_s.add(down.s, up.s, gap, lost);
        below_p.add(down.p, up.p, gap, lost);
    }
    keep_once(redo);
    if (s) below_s.store(*s);
    if (p) below_p.store(*p);
}

void compile_layers(const Chain& chain, std::span<const std::size_t> listed,
                    const std::vector<bool>& absorbs, ChainLayers& layers) {
    const std::size_t last = chain.gaps.size();
    layers.blocks.resize(last + 1);
    std::size_t next = 0;           // layer written out
    std::uint32_t next_listed = 0;  // layer listed
    for (std::size_t i = 0; i <= last; ++i) {
        ChainLayers::Block& block = layers.blocks[i];
        const std::vector<Layer> down = written_out(chain.blocks[i].down);
        std::vector<std::size_t> own(down.size());
        block.first = block.end = next_listed;
        for (std::size_t j = 0; j < down.size(); ++j) {
            own[j] = (listed.empty() ? next + j : listed[next + j]) - next_listed;
            block.end = next_listed + static_cast<std::uint32_t>(own[j]) + 1;
        }
        next += down.size() + 1;
        next_listed = block.end + 1;
        const std::size_t below = i == last ? chain.substrate : chain.gaps[i].material;
        compile_layers(down, own, below, absorbs, block.down);
        if (i == last) break;
        const std::size_t above = i == 0 ? Program::kIncident : chain.gaps[i - 1].material;
        std::ranges::reverse(own);
        compile_layers(written_out(chain.blocks[i].up), own, above, absorbs, block.up);
    }
}

void run_chain_layers(const ChainProgram& chain, const ChainLayers& layers, const PointRun& run,
                      const LayerOutput* s, const LayerOutput* p, std::vector<std::size_t>& redo,
                      RunMemory& memory, SimdLevel level) {
    const std::size_t last = chain.gaps.size();
    if (last == 0) return run_layers(layers.blocks[0].down, run, s, p, redo, memory, level);
    RunFrom above(chain, run);
    std::vector<BothRuns> downs, ups;
    std::vector<std::vector<Attenuation>> gaps;
    const auto pass = [&](const Program& program, const PointRun& points) {
        return BothRuns(program, points, s, p, BlockExtra::amplitude, redo, memory, level);
    };
    for (std::size_t i = 0; i <= last; ++i) {
        downs.push_back(pass(chain.down[i], above(i)));
        if (i == last) break;
        ups.push_back(pass(chain.up[i], above(i + 1)));
        gaps.push_back(attenuations(chain.gaps[i], run, redo));
    }
    keep_once(redo);
    std::vector<char> lost(run.count);
    for (const std::size_t point : redo) lost[point] = 1;
    std::vector<LayersOfPolarization> outputs;
    for (const LayerOutput* out : {s, p}) {
        if (!out) continue;
        const auto polarization = out == s ? Polarization::s : Polarization::p;
        LayersOfPolarization& to = outputs.emplace_back(*out, chain, run, polarization, lost);
        for (BothRuns& down : downs) to.downs.push_back(out == s ? &down.s : &down.p);
        for (BothRuns& up : ups) to.ups.push_back(out == s ? &up.s : &up.p);
        to.find_light(gaps);
    }
    std::vector<double> part_s, part_p;
    for (std::size_t i = 0; i <= last; ++i) {
        const ChainLayers::Block& block = layers.blocks[i];
        for (const bool up : {false, true}) {
            if (up && i == last) break;
            const std::size_t count = block.end - block.first;
            part_s.resize(s ? count * run.count : 0);
            part_p.resize(p ? count * run.count : 0);
            const LayerOutput to_s{part_s.data(), run.count, 1}, to_p{part_p.data(), run.count, 1};
            run_layers(up ? block.up : block.down, up ? above(i + 1) : above(i),
                       s ? &to_s : nullptr, p ? &to_p : nullptr, redo, memory, level);
            for (LayersOfPolarization& output : outputs)
                output.add_block(i, up, block, output.is_s() ? part_s : part_p);
        }
        if (i < last)
            for (LayersOfPolarization& output : outputs) output.add_gap(i, block.end);
    }
    keep_once(redo);
}

}  // namespace irido
