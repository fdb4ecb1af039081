# What is in the tables of doc/gallery.md: sourced by bench/gallery.sh, whose functions these are.
rigid=(--align rigid)
told() { printf -- '--set\n%s\n' "$1.clutter_per_scan=$2" "$1.detection_probability=$3"; }

if begin experiment1; then
  simulated sim.experiment1.ini
  row rbpf-slamot rbpf-slamot.experiment1.ini
  row ekf-slamot ekf-slamot.experiment1.ini
  row independent independent.experiment1.ini
  row odometry odometry.experiment1.ini
  row true-pose-target true-pose-target.experiment1.ini
  row dead-reckoning dead-reckoning.ini
  picture rbpf-slamot
  end robot coverage nees landmarks targets target_coverage cpu
fi
if begin loop; then
  simulated sim.loop.ini
  judged=(--landmark-cutoff 5)
  row slamot slamot.ini
  row "ekf-slamot, nearest neighbour" ekf-slamot.ini --set ekf-slamot.association=nn --set ekf-slamot.confirm_sightings=3
  row "rbpf-slamot, nearest neighbour" rbpf-slamot.ini --set rbpf-slamot.association=nn --set rbpf-slamot.confirm_sightings=3
  row fastslam1 fastslam1.ini
  row fastslam2 fastslam2.ini
  row ufastslam ufastslam.ini
  row gmphd-ufastslam gmphd-ufastslam.ini
  row dead-reckoning dead-reckoning.ini
  picture slamot --from-above
  end robot coverage nees landmarks mapped false cpu
fi
if begin clutter; then
  judged=(--landmark-cutoff 5)
  simulated sim.loop-dense.ini --set landmark_sensor.clutter_per_scan=2 --set landmark_sensor.detection_probability=0.8
  row slamot slamot.ini $(told slamot 2 0.8)
  row ufastslam ufastslam.ini $(told ufastslam 2 0.8)
  row gmphd-ufastslam gmphd-ufastslam.ini $(told gmphd-ufastslam 2 0.8)
  row fastslam2 fastslam2.ini $(told fastslam2 2 0.8)
  row "ekf-slamot, nearest neighbour" ekf-slamot.ini --set ekf-slamot.association=nn --set ekf-slamot.confirm_sightings=3 \
    --set ekf-slamot.landmark_tentative_s=2
  end robot coverage nees landmarks mapped false cpu
fi
if begin post-field; then
  simulated sim.post-field.ini
  row slamot slamot.ini
  row rbpf-slamot rbpf-slamot.post-field.ini
  row "ekf-slamot, joint compatibility" ekf-slamot.ini --set ekf-slamot.association=jcbb --set ekf-slamot.confirm_sightings=3
  row ufastslam ufastslam.ini $(told ufastslam 0.1 0.95)
  row dead-reckoning dead-reckoning.ini
  end robot coverage nees landmarks mapped false targets tracked cpu
fi
if begin crossing-targets; then
  simulated sim.crossing-targets.ini
  cautious=(--set rbpf-slamot.target_confirm_sightings=8 --set rbpf-slamot.target_lost_s=0.6)
  set_of=(--set rbpf-slamot.targets=gm-phd --set rbpf-slamot.target_detection_probability=0.9
    --set rbpf-slamot.target_clutter_per_scan=2 --set rbpf-slamot.target_lost_s=2)
  row "rbpf-slamot, targets as tracks" rbpf-slamot.ini "${cautious[@]}"
  row "rbpf-slamot, targets as a random finite set" rbpf-slamot.ini "${set_of[@]}"
  row "slamot, targets as tracks" slamot.ini --set slamot.target_confirm_sightings=8 --set slamot.target_lost_s=0.6
  row dead-reckoning dead-reckoning.ini
  picture "rbpf-slamot, targets as a random finite set"
  end robot coverage landmarks gospa tracked cpu
fi
if begin manoeuvre; then
  simulated sim.manoeuvre.ini
  for filter in rbpf-slamot ekf-slamot; do
    row "$filter, a bank of models" $filter.manoeuvre.ini
    row "$filter, constant velocity" $filter.manoeuvre.ini --set $filter.target_motion=constant-velocity \
      --set $filter.target_acceleration_noise_mps2_per_sqrt_hz=1
    row "$filter, constant turn" $filter.manoeuvre.ini --set $filter.target_motion=differential-drive \
      --set $filter.target_speed_noise_mps=0.8 --set $filter.target_turn_rate_noise_deg_per_s=34.38
  done
  end robot targets target_heading target_coverage tracked cpu
fi
if begin glint; then
  simulated sim.glint-polar.ini
  row imm-tracker imm-tracker.ini --set imm-tracker.observation=polar
  row particle-tracker particle-tracker.ini --set particle-tracker.observation=polar
  row kalman-tracker kalman-tracker.ini --set kalman-tracker.observation=polar
  picture imm-tracker --from-above
  end targets target_coverage tracked cpu
fi
if begin pioneers; then
  simulated sim.pioneers.ini
  detected detect.ini
  row slamot slamot.ini
  row "rbpf-slamot, nearest neighbour" rbpf-slamot.ini --set rbpf-slamot.association=nn
  row scan-slam scan-slam.ini
  row scan-slamot scan-slamot.ini
  row dead-reckoning dead-reckoning.ini
  end robot coverage nees landmarks targets tracked entropy cpu
fi
if begin kf-slam-demo; then
  demo=/usr/share/mrpt/datasets/kf-slam_demo
  if [ -r $demo.rawlog ]; then
    log=$out/$table/kf-slam_demo
    ln -sf $demo.rawlog "$log.rawlog"
    if [ ! -e "$log.truth" ]; then
      "$slamot" run config-ini/rbpf-slamot.kf-slam-demo.ini "$log.rawlog" -q -o "$log.times"
      mkdir "$log.truth"
      awk -f bench/kf-slam/path.awk "$log.times/robot.tum" ${demo}_ground_truth_robot_path.txt >"$log.truth/robot.tum"
      awk 'BEGIN { print "id,x,y" } NF == 7 { print $7 "," $1 "," $2 }' ${demo}_ground_truth.txt >"$log.truth/landmarks.csv"
    fi
    logged "$log.rawlog" $demo.rawlog
    set_log=(--set log.step_period_s=0.1 --set log.first_frame=use)
    row rbpf-slamot rbpf-slamot.kf-slam-demo.ini
    row "rbpf-slamot, no identities" rbpf-slamot.kf-slam-demo.ini --set rbpf-slamot.association=nn
    row ekf-slamot ekf-slamot.ini "${set_log[@]}"
    row "slamot, no identities" slamot.ini "${set_log[@]}"
    row dead-reckoning dead-reckoning.ini "${set_log[@]}"
    picture rbpf-slamot
    end robot coverage nees landmarks mapped false cpu
  else
    say "   skipped: MRPT's logs are missing: apt-get install mrpt-common"
  fi
fi
wheels=(--odometry-delay 0.22 --std-heading 0.3 --std-heading-turning 0.12)
if begin mrclam && has mrclam; then
  imported mrclam mrclam "$(path mrclam)" --robot 3 "${wheels[@]}"
  row rbpf-slamot rbpf-slamot.mrclam.ini "${rigid[@]}"
  row independent independent.mrclam.ini "${rigid[@]}"
  row dead-reckoning dead-reckoning.ini "${rigid[@]}"
  picture rbpf-slamot --from-above
  end robot coverage nees landmarks mapped false targets tracked cpu
fi
if begin mrclam-unlabelled && has mrclam; then
  imported unlabelled mrclam "$(path mrclam)" --robot 3 --no-landmark-ids --no-target-ids "${wheels[@]}"
  row slamot slamot.mrclam-unlabelled.ini "${rigid[@]}"
  row rbpf-slamot rbpf-slamot.mrclam-unlabelled.ini "${rigid[@]}"
  end robot coverage nees landmarks mapped false targets tracked cpu
fi
if begin victoria-park && has victoria-park; then
  imported park victoria-park "$(path victoria-park)"
  row slamot slamot.victoria-park.ini "${rigid[@]}"
  row rbpf-slamot rbpf-slamot.victoria-park.ini "${rigid[@]}"
  row ufastslam ufastslam.victoria-park.ini "${rigid[@]}"
  row gmphd-ufastslam gmphd-ufastslam.victoria-park.ini "${rigid[@]}"
  row "ekf-slamot, nearest neighbour" ekf-slamot.ini --set ekf-slamot.association=nn --set ekf-slamot.local_radius_m=160 \
    --set ekf-slamot.confirm_sightings=10 "${rigid[@]}"
  row dead-reckoning dead-reckoning.ini "${rigid[@]}"
  end robot coverage mapped cpu
fi
if begin intel && has intel; then
  relations=()
  [[ ${given[intel]} != *,* ]] || relations=(--relations "$(path intel ,)")
  imported intel carmen "$(path intel)" "${relations[@]}"
  row scan-slam scan-slam.ini
  row dead-reckoning dead-reckoning.ini
  end relations path_relations entropy path_entropy cpu
fi
if begin csail && has csail; then
  imported csail carmen "$(path csail)"
  judged=(--scans "$out/csail/csail.rawlog")  # there is no truth
  row scan-slam scan-slam.ini
  row dead-reckoning dead-reckoning.ini
  end entropy path_entropy cpu
fi
if begin scaled-cars && has scaled-cars; then
  for run in overtakes parallel_a two_robots; do
    imported $run scaled-cars "$(path scaled-cars)/$run"
    row "scan-slamot, $run" scan-slamot.scaled-cars.ini
  done
  end robot coverage targets target_coverage tracked cpu
fi
