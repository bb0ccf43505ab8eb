#include "core/vector/chain_program.hpp"

#include <algorithm>
#include <cmath>

#include "core/incoherent/incoherent.hpp"

namespace irido {

namespace {

double value_at(const Stream& stream, std::size_t point) {
    return stream.values[stream.varies ? point : 0];
}

/// What the kernel's stand-in for a kz of 0 can leave of A in a gap without absorption.
constexpr double kNoAbsorption = 1e-130;

/// Powers of all points of a run in one polarization.
struct BlockRun {
    std::vector<double> R, T, A, denominator_re, denominator_im, log_scale;

    BlockRun(std::size_t points, bool with_denominators) : R(points), T(points), A(points) {
        if (!with_denominators) return;
        for (auto* values : {&denominator_re, &denominator_im, &log_scale}) values->resize(points);
    }
    RunOutput output() {
        RunOutput out{.R = R.data(), .T = T.data(), .A = A.data()};
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
             bool with_denominators, std::vector<std::size_t>& redo, RunMemory& memory,
             SimdLevel level)
        : s(with_s ? run.count : 0, with_denominators),
          p(with_p ? run.count : 0, with_denominators) {
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

/// Of a gap; `redo` receives the points at which it is no gap, or has not its own wave.
std::vector<Attenuation> attenuations(const Layer& gap, const PointRun& run,
                                      std::vector<std::size_t>& redo) {
    std::vector<Attenuation> result;
    for (std::size_t i = 0; i < run.count; ++i) {
        const Complex index{value_at(run.n[gap.material], i), value_at(run.k[gap.material], i)};
        const IncidentAngle at{value_at(run.cos_theta, i), value_at(run.sin_theta, i)};
        const Medium inside = medium(index, value_at(run.incident, i), at);
        const double k0_d = value_at(run.k0, i) * gap.thickness_nm;
        if (!travels(inside) || k0_d == 0 || !has_own_wave(inside, k0_d)) redo.push_back(i);
        result.push_back(attenuation(inside, k0_d));
    }
    return result;
}

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
    PointRun from_gap = run;
    const auto pass = [&](const Program& program, const PointRun& points) {
        return BothRuns(program, points, s, p, with_denominators, redo, memory, level);
    };
    const auto above = [&](std::size_t block) -> const PointRun& {
        if (block == 0) return run;
        from_gap.above = chain.gaps[block - 1].material;
        return from_gap;
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
    std::ranges::sort(redo);
    redo.erase(std::unique(redo.begin(), redo.end()), redo.end());
    if (s) below_s.store(*s);
    if (p) below_p.store(*p);
}

}  // namespace irido
