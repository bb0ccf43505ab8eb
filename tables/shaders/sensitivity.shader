//! use: common
// One level of irido_sensitivity(): the real parts fill the left half, the imaginary parts the
// right half.
void irido_sensitivity_level(TEXTURE2D(table), float3 opd_axis, float3 carrier_nm, float opd_nm,
                             float level, OUT(float3, re), OUT(float3, im))
{
    float u = 0.5 * irido_texel(opd_nm, irido_axis_of_level(opd_axis, level));
    float3 a = SAMPLE2D(table, float2(u, 0.5), level).rgb;
    float3 b = SAMPLE2D(table, float2(u + 0.5, 0.5), level).rgb;
    if (carrier_nm.x > 0.0)
    {
        float3 turn = 6.28318530718 * fract(float3(opd_nm, opd_nm, opd_nm) / carrier_nm);
        RESULT(re) = a * cos(turn) - b * sin(turn);
        RESULT(im) = a * sin(turn) + b * cos(turn);
    }
    else
    {
        RESULT(re) = a;
        RESULT(im) = b;
    }
}

// H_X, H_Y, H_Z at an optical path in nm: the real parts and the imaginary parts.
// carrier_nm  the metadata's request.carrier_nm; 0 for a table that has its carrier
// level       of the table's spreads, 0 being the first; in between, two levels are mixed
void irido_sensitivity(TEXTURE2D(table), float3 opd_axis, float3 carrier_nm, float opd_nm,
                       float level, OUT(float3, re), OUT(float3, im))
{
    float low = floor(level);
    float3 re_low, im_low, re_high, im_high;
    irido_sensitivity_level(PASS2D(table), opd_axis, carrier_nm, opd_nm, low, ASK(re_low),
                            ASK(im_low));
    if (level > low)
    {
        irido_sensitivity_level(PASS2D(table), opd_axis, carrier_nm, opd_nm, low + 1.0, ASK(re_high),
                                ASK(im_high));
        re_low = lerp(re_low, re_high, level - low);
        im_low = lerp(im_low, im_high, level - low);
    }
    RESULT(re) = re_low;
    RESULT(im) = im_low;
}

float3 irido_sensitivity_real_level(TEXTURE2D(table), float3 opd_axis, float opd_nm, float level)
{
    float u = irido_texel(opd_nm, irido_axis_of_level(opd_axis, level));
    return SAMPLE2D(table, float2(u, 0.5), level).rgb;
}

// The real parts, of a table made with --real.
float3 irido_sensitivity_real(TEXTURE2D(table), float3 opd_axis, float opd_nm, float level)
{
    float low = floor(level);
    float3 re = irido_sensitivity_real_level(PASS2D(table), opd_axis, opd_nm, low);
    if (level > low)
    {
        float3 next = irido_sensitivity_real_level(PASS2D(table), opd_axis, opd_nm, low + 1.0);
        re = lerp(re, next, level - low);
    }
    return re;
}
