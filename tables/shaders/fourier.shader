//! use: common complex sensitivity
// XYZ of the light that one film reflects, from the series of its fringes and the table
// `sensitivity` (Belcour and Barla 2017, with exact polarized Fresnel terms and the base's phase):
// irido_film() over any base, irido_film_real() over one that does not absorb, for a table of real
// parts (--real), irido_film_without_fringes() where no order is left, without a table.
// n1, n2      indices of the incident medium and of the film
// n3          complex index of the base, (n, k), or n alone
// cos_theta   of the angle of incidence, in medium 1
// orders      of the series; where the paths leave the table the fringes are taken as gone
// level_sigma_nm      spreads of the path that are the table's levels, ascending, the last one again
//                     if there are fewer than four; 0 for a table of one level
// thickness_sigma_nm  spread of the thickness in the pixel: that of order m's path is m times as
//                     much as the first one's
// white_xyz   of the light; rgb_from_xyz of a baked scene's manifest leads on from XYZ
// Past the film's critical angle there is no such series: the result there is the white, which is
// wrong where light tunnels through a thin film. Take a table of colours for such stacks.

// For artists: a film index for n2 above that goes to the incident medium's as the path 2 n2 d goes
// to 0, so that the thinnest films vanish. Belcour and Barla take width_nm = 30; 0 changes nothing.
float irido_remapped_index(float n1, float n2, float thickness_nm, float width_nm)
{
    float t = clamp(2.0 * n2 * thickness_nm / max(width_nm, 1e-6), 0.0, 1.0);
    return lerp(n1, n2, width_nm > 0.0 ? t * t * (3.0 - 2.0 * t) : 1.0);
}

// How much is left of a fringe at 550 nm.
float irido_fade(float sigma_nm)
{
    float waves = sigma_nm / 550.0;
    return exp(-19.7392088 * waves * waves);
}

// The table's level for a spread of the path; in between, light of 550 nm fades as it must.
float irido_level_of_spread(float4 level_sigma_nm, float sigma_nm)
{
    if (level_sigma_nm.w <= 0.0 || sigma_nm <= 0.0) return 0.0;
    float level = 0.0, low = level_sigma_nm.x, high = level_sigma_nm.y;
    if (sigma_nm > level_sigma_nm.y && level_sigma_nm.z > level_sigma_nm.y)
    {
        level = 1.0;
        low = level_sigma_nm.y;
        high = level_sigma_nm.z;
    }
    if (sigma_nm > level_sigma_nm.z && level_sigma_nm.w > level_sigma_nm.z)
    {
        level = 2.0;
        low = level_sigma_nm.z;
        high = level_sigma_nm.w;
    }
    float from = irido_fade(low), to = irido_fade(high);
    return level + clamp((from - irido_fade(sigma_nm)) / max(from - to, 1e-9), 0.0, 1.0);
}

// T_0 of the series in polarization p (0 is s) and the amplitude of one bounce, r21 r23; the film
// must not reflect totally. q2 = n2 cos(theta2).
float irido_film_terms(float n1, float n2, float2 n3, float cos_theta, int p, out float q2,
                       out float2 bounce)
{
    float s2 = n1 * n1 * (1.0 - cos_theta * cos_theta);
    float q1 = n1 * cos_theta;
    q2 = sqrt(n2 * n2 - s2);
    float2 eps3 = irido_mul(n3, n3);
    float2 q3 = irido_sqrt(eps3 - float2(s2, 0.0));
    // admittances: q for s, eps / q for p
    float y1 = p == 0 ? q1 : n1 * n1 / q1;
    float y2 = p == 0 ? q2 : n2 * n2 / q2;
    float2 y3 = p == 0 ? q3 : irido_div(eps3, q3);
    float r12 = (y1 - y2) / (y1 + y2);
    float2 r23 = irido_div(float2(y2, 0.0) - y3, float2(y2, 0.0) + y3);
    float R12 = r12 * r12, R23 = dot(r23, r23);
    bounce = -r12 * r23;
    return (1.0 - R12) * (1.0 - R23) / (1.0 - R12 * R23);
}

bool irido_film_is_total(float n1, float n2, float cos_theta)
{
    return n1 * n1 * (1.0 - cos_theta * cos_theta) >= n2 * n2 || cos_theta <= 0.0;
}

float3 irido_film(TEXTURE2D(table), float3 opd_axis, float3 carrier_nm, float4 level_sigma_nm,
                  float n1, float n2, float2 n3, float thickness_nm, float thickness_sigma_nm,
                  float cos_theta, int orders)
{
    float3 white, nothing, re, im;
    irido_sensitivity(PASS2D(table), opd_axis, carrier_nm, 0.0, 0.0, white, nothing);
    if (irido_film_is_total(n1, n2, cos_theta)) return white;
    float3 xyz = float3(0.0, 0.0, 0.0);
    for (int p = 0; p < 2; ++p)
    {
        float q2;
        float2 bounce, power = float2(1.0, 0.0);
        float T0 = irido_film_terms(n1, n2, n3, cos_theta, p, q2, bounce);
        float3 sum = (1.0 - T0) * white;
        for (int m = 1; m <= orders; ++m)
        {
            float path = 2.0 * float(m) * thickness_nm * q2;
            if (path > opd_axis.y) break;
            power = irido_mul(power, bounce);
            float level = irido_level_of_spread(level_sigma_nm,
                                                2.0 * float(m) * thickness_sigma_nm * q2);
            irido_sensitivity(PASS2D(table), opd_axis, carrier_nm, path, level, re, im);
            sum -= 2.0 * T0 * (power.x * re - power.y * im);
        }
        xyz += 0.5 * sum;
    }
    return xyz;
}

float3 irido_film_real(TEXTURE2D(table), float3 opd_axis, float4 level_sigma_nm, float n1, float n2,
                       float n3, float thickness_nm, float thickness_sigma_nm, float cos_theta,
                       int orders)
{
    float3 white = irido_sensitivity_real(PASS2D(table), opd_axis, 0.0, 0.0);
    if (irido_film_is_total(n1, n2, cos_theta)) return white;
    float3 xyz = float3(0.0, 0.0, 0.0);
    for (int p = 0; p < 2; ++p)
    {
        float q2, power = 1.0;
        float2 bounce;
        float T0 = irido_film_terms(n1, n2, float2(n3, 0.0), cos_theta, p, q2, bounce);
        float3 sum = (1.0 - T0) * white;
        for (int m = 1; m <= orders; ++m)
        {
            float path = 2.0 * float(m) * thickness_nm * q2;
            if (path > opd_axis.y) break;
            power *= bounce.x;
            float level = irido_level_of_spread(level_sigma_nm,
                                                2.0 * float(m) * thickness_sigma_nm * q2);
            sum -= 2.0 * T0 * power *
                   irido_sensitivity_real(PASS2D(table), opd_axis, path, level);
        }
        xyz += 0.5 * sum;
    }
    return xyz;
}

float3 irido_film_without_fringes(float3 white_xyz, float n1, float n2, float2 n3, float cos_theta)
{
    if (irido_film_is_total(n1, n2, cos_theta)) return white_xyz;
    float q2;
    float2 bounce;
    float T0 = irido_film_terms(n1, n2, n3, cos_theta, 0, q2, bounce) +
               irido_film_terms(n1, n2, n3, cos_theta, 1, q2, bounce);
    return (1.0 - 0.5 * T0) * white_xyz;
}
