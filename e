sealpend: planar, 2 bodies, 1 freedom (0 fast), gravity, midpoint to tolerance 0.0001 (the deck has no 'step' and no 'tolerance'), to t = 8 s, 16001 records of 11 columns
auto: midpoint, which takes rigid contacts
warning: t = 0.3005 s: the energy balance is off by 0.2 of ||W||, for the first time
done at t = 8 s: 20170 major, 20170 minor steps (129 rejected), 182927 slow and 182927 fast evaluations, 50470 factorizations; 0.277 s
energy balance kept: off by 9.7e+02 nJ of 14.1 J (6.9e-08; limit 0.01)
estimated error: 4e-06 of the range of 'energy.gravity', summed over the steps; whether small differences grow was not looked at: `fmdsub run --verify` measures it
