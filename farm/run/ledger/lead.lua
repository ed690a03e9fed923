-- Makes an owner the one that queues a dataset's jobs, or keeps it so for longer.
--
-- KEYS[1]  leader: the owner that queues the jobs
-- ARGV[1]  owner that asks
-- ARGV[2]  milliseconds until its lead lapses
-- Returns  1; 0 if another owner leads, and then nothing changes

local leader = redis.call('GET', KEYS[1])
if leader and leader ~= ARGV[1] then
    return 0
end
redis.call('SET', KEYS[1], ARGV[1], 'PX', ARGV[2])
return 1
