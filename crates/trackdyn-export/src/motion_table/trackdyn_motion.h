#ifndef TRACKDYN_MOTION_H
#define TRACKDYN_MOTION_H

#include <math.h>

#define TRACKDYN_SIZES @SIZES@
#define TRACKDYN_ANGLES @ANGLES@

/* Of each sector, of each polynomial in the speed, of each in the direction: forward, left, yaw. */
static const double trackdyn_coefficients[8 * TRACKDYN_SIZES * TRACKDYN_ANGLES][3] = {
@COEFFICIENTS@};

/* Chebyshev's polynomials at 2 x - 1, and their derivatives by x. */
static inline void trackdyn_chebyshev(int count, double x, double *value, double *slope)
{
    double z = 2.0 * x - 1.0;
    value[0] = 1.0;
    slope[0] = 0.0;
    if (count > 1) {
        value[1] = z;
        slope[1] = 2.0;
    }
    for (int k = 2; k < count; ++k) {
        value[k] = 2.0 * z * value[k - 1] - value[k - 2];
        slope[k] = 4.0 * value[k - 1] + 2.0 * z * slope[k - 1] - slope[k - 2];
    }
}

/* Twist in ROS axes (forward m/s, left m/s, yaw rad/s) at the speeds of the left and the right
   encoder, m/s, and its derivatives by these two speeds. */
static inline void trackdyn_motion(double v_left, double v_right, double twist[3],
                                   double by_speed[3][2])
{
    const double gain[2] = {@GAIN_LEFT@, @GAIN_RIGHT@};
    const double largest = @LARGEST@;
    const double eighth = 0.78539816339744830962;
    double belt[2] = {gain[0] * v_left, gain[1] * v_right};
    double norm = sqrt(belt[0] * belt[0] + belt[1] * belt[1]);
    double per_norm = norm > 0.0 ? 1.0 / norm : 0.0;
    double size = @SIZE@;
    double size_by_norm = size >= 0.0 && size <= 1.0 ? @SIZE_BY_NORM@ : 0.0;
    size = size < 0.0 ? 0.0 : size > 1.0 ? 1.0 : size;
    double turn = atan2(belt[1], belt[0]) / eighth;
    turn = turn < 0.0 ? turn + 8.0 : turn;
    int sector = (int)turn;
    sector = sector > 7 ? 7 : sector;

    double t_s[TRACKDYN_SIZES + 1], d_s[TRACKDYN_SIZES + 1];
    double t_a[TRACKDYN_ANGLES + 1], d_a[TRACKDYN_ANGLES + 1];
    trackdyn_chebyshev(TRACKDYN_SIZES, size, t_s, d_s);
    trackdyn_chebyshev(TRACKDYN_ANGLES, turn - sector, t_a, d_a);
    double value[3] = {0.0}, by_size[3] = {0.0}, by_angle[3] = {0.0};
    for (int j = 0; j < TRACKDYN_SIZES; ++j) {
        for (int k = 0; k < TRACKDYN_ANGLES; ++k) {
            const double *c =
                trackdyn_coefficients[(sector * TRACKDYN_SIZES + j) * TRACKDYN_ANGLES + k];
            for (int i = 0; i < 3; ++i) {
                value[i] += t_s[j] * t_a[k] * c[i];
                by_size[i] += d_s[j] * t_a[k] * c[i];
                by_angle[i] += t_s[j] * d_a[k] * c[i];
            }
        }
    }

    double scale = @SCALE@;
    const double scale_by[2] = {@SCALE_BY_LEFT@, @SCALE_BY_RIGHT@};
    const double size_by[2] = {size_by_norm * belt[0] * per_norm,
                               size_by_norm * belt[1] * per_norm};
    double per_angle = per_norm * per_norm / eighth;
    const double angle_by[2] = {-belt[1] * per_angle, belt[0] * per_angle};
    for (int i = 0; i < 3; ++i) {
        twist[i] = value[i] * scale + (i == 0 ? 0.5 * (belt[0] + belt[1]) : 0.0);
        for (int side = 0; side < 2; ++side) {
            double by_place = by_size[i] * size_by[side] + by_angle[i] * angle_by[side];
            by_speed[i][side] = gain[side] * (by_place * scale + value[i] * scale_by[side]
                                              + (i == 0 ? 0.5 : 0.0));
        }
    }
}

#endif
